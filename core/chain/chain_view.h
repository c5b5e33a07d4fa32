#pragma once
#include <cstdint>

#include "catena/core/chain/exclusion.h"
#include "catena/core/chain/neighbour_reach.h"
#include "catena/core/export.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// How large a chain's spheres are and how far they lie apart, known since its numbers were checked; all 0
/// for no spheres.
struct CATENA_API Extent {
  float least_radius, greatest_radius;
  double sides;               ///< sum of the three sides of the box of all centres
  float greatest_coordinate;  ///< greatest |x|, |y| or |z| of a centre
};

/// A chain as plain pointers, valid in one memory space; what kernels and policies take.
struct CATENA_API ChainView {
  const Sphere* spheres;
  std::uint32_t size;
  std::uint32_t strand_count;
  std::uint32_t extra_count;  ///< entries of exclusion.extra
  ExclusionView exclusion;
  Extent extent;
  std::uint64_t topology;  ///< Topology::number: equal numbers, equal exclusion; 0: unknown
  NeighbourReach reach{};  ///< of the host's searches

  CATENA_HD bool neighbours(std::uint32_t i, std::uint32_t j) const {
    // Not from memory, far away for a kernel, where the rule asks for none.
    const bool radii = exclusion.rule == Exclusion::Rule::arc_window;
    return exclusion.neighbours(i, j, radii ? spheres[i].radius : 0, radii ? spheres[j].radius : 0);
  }
};

}  // namespace catena
