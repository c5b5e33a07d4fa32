#pragma once
#include <cstdint>

#include "catena/bench/pivot/symmetry.h"

namespace catena::bench {

/// One move of the pivot algorithm: every point after `site` is turned about it.
struct Pivot {
  std::uint32_t site;  ///< 0 to points - 2
  LatticeSymmetry turn;
};

}  // namespace catena::bench
