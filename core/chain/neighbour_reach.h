#pragma once
#include <cstdint>

#include "catena/core/export.h"

namespace catena {

struct Topology;

/// What the numbers i < j of two spheres alone say of whether they are neighbours.
struct CATENA_API NeighbourReach {
  static constexpr std::uint32_t any = ~0u;

  std::uint32_t certain = 0;     ///< no more steps apart on one strand they are
  std::uint32_t furthest = any;  ///< more steps apart they are none
  std::uint32_t around =
      any;  ///< but for those at least so many, who may be around the end of a closed strand

  /// False also where only a look at them tells.
  bool none(std::uint32_t i, std::uint32_t j) const { return j - i > furthest && j - i < around; }
};

/// Under an index window it is exact, but where there are extra pairs: then any two may be neighbours. Under
/// an arc window it is told by one arc length in 8 and by the least and the greatest radius of all, on the
/// safe side. O(strands), and O(n / 8) under an arc window.
NeighbourReach neighbour_reach(const Topology& topology, float least_radius, float greatest_radius);

}  // namespace catena
