#pragma once
#include <cstdint>

#include "catena/core/chain/exclusion.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// What scale a chain's radii have, known since its numbers were checked: arithmetic may leave out what is
/// for other scales (Robust::in_range).
struct RadiusRange {
  float least;  ///< no sphere has a smaller radius
  float reach;  ///< no two bounds of a tree of parents over the chain have radii of a greater sum
};

/// A chain as plain pointers, valid in one memory space; what kernels and policies take.
struct ChainView {
  const Sphere* spheres;
  std::uint32_t size;
  std::uint32_t strand_count;
  std::uint32_t extra_count;  ///< entries of exclusion.extra
  ExclusionView exclusion;
  RadiusRange radii;
  std::uint64_t topology;  ///< Topology::number: equal numbers, equal exclusion; 0: unknown

  CATENA_HD bool neighbours(std::uint32_t i, std::uint32_t j) const {
    return exclusion.neighbours(i, j, spheres[i].radius, spheres[j].radius);
  }
};

}  // namespace catena
