#include "catena/core/blocks/squares_in_range.h"

#include "catena/core/arithmetic/slow_subnormals.h"

namespace catena {

double single_spheres_share(const Extent& extent) {
  constexpr double slow = 6;
  constexpr float differences_are_subnormal = 0x1p-100f;  // of centres about so far apart, in their last bits
  if (squares_in_range(extent.greatest_radius)) return 1;
  if (!sums_in_range(extent)) return slow;
  return extent.greatest_radius < differences_are_subnormal && subnormals_are_slow() ? slow : 1;
}

}  // namespace catena
