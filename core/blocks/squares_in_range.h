#pragma once
#include "catena/core/chain/chain_view.h"

namespace catena {

/// Whether squares of distances such as this radius keep their digits in binary32. Where they do not, the
/// chain's order scales its numbers, and tests of single spheres scale what they compare.
inline bool squares_in_range(float radius) { return radius == 0 || (radius > 0x1p-44f && radius < 0x1p58f); }

/// Whether no difference of centres and no sum of radii overflows: only what is finite can be scaled then.
/// Where they do, tests of single spheres leave each pair that is near to the exact stage.
inline bool differences_in_range(const Extent& extent) {
  return extent.greatest_coordinate < 0x1p126f && extent.greatest_radius < 0x1p126f;
}

}  // namespace catena
