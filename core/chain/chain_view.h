#pragma once
#include <cstdint>

#include "catena/core/chain/exclusion.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// A chain as plain pointers, valid in one memory space; what kernels and policies take.
struct ChainView {
  const Sphere* spheres;
  std::uint32_t size;
  std::uint32_t strand_count;
  std::uint32_t extra_count;  ///< entries of exclusion.extra
  ExclusionView exclusion;

  CATENA_HD bool neighbours(std::uint32_t i, std::uint32_t j) const {
    return exclusion.neighbours(i, j, spheres[i].radius, spheres[j].radius);
  }
};

}  // namespace catena
