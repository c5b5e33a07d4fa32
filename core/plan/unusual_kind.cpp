#include "catena/core/plan/unusual_kind.h"

#include <array>
#include <cmath>
#include <limits>

namespace catena {
namespace {

enum Kind { wide, subnormal, short_crowded, short_sparse };

const UnusualKind& info(Kind kind) {
  static const std::array<UnusualKind, 4> all{{
      {"aCPU2+Dual", "radii of which one is more than 2^60 times another"},
      {"Grid", "radii that are subnormal, with which other searches multiply, at 150 cycles each"},
      {"Grid", "at most 2,048 spheres, which fill a quarter of their box"},
      {"ChainTree", "at most 2,048 spheres, in a box that is mostly empty, or of unlike radii"},
  }};
  return all[kind];
}

/// About which share of the cube that is as wide as the chain, on average of three sides, cubes around the
/// spheres would fill.
double fill(std::uint32_t n, const Extent& extent) {
  const double width = 2.0 * extent.greatest_radius, side = extent.sides / 3 + width;
  const double cells = side > 0 ? side / width : 1;
  return n / (cells * cells * cells);
}

}  // namespace

const UnusualKind* UnusualKind::of(std::uint32_t n, const Extent& extent) {
  // Measured over the registry's scenes: below, these take 0.3 to 0.9 of the usual variant's time.
  constexpr double widest = 0x1p60, crowded = 0.25;
  constexpr std::uint32_t few = 2048;  // no node of 128 spheres can meet so many others that it is crowded
  if (extent.greatest_radius > 0) {
    if (extent.least_radius > 0 && extent.greatest_radius > widest * extent.least_radius) return &info(wide);
    if (extent.greatest_radius < std::numeric_limits<float>::min()) return &info(subnormal);
    const bool full = fill(n, extent) > crowded, like = extent.greatest_radius <= 2 * extent.least_radius;
    if (n <= few) return full && like ? &info(short_crowded) : &info(short_sparse);
  }
  return nullptr;
}

}  // namespace catena
