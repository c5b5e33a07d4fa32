#include "catena/core/plan/unusual_kind.h"

#include <array>
#include <cmath>
#include <limits>

#include "catena/core/hierarchy/box.h"

namespace catena {
namespace {

enum Kind { wide, subnormal, crowded, short_crowded, short_dense, short_sparse };

const UnusualKind& info(Kind kind) {
  static const std::array<UnusualKind, 6> all{{
      {"aCPU2+Dual", "radii of which one is more than 2^60 times another, in a chain whose parts lie apart"},
      {"Grid", "radii that are subnormal, with which other searches multiply, at 150 cycles each"},
      {"Grid", "spheres of like radii that fill their box, in a chain whose parts lie among one another",
       true},
      {"Grid",
       "at most 2,048 spheres of like radii, which fill a quarter of their box to six times all of it"},
      {"SphereTree", "at most 2,048 spheres, which fill their box more than six times or have unlike radii"},
      {"ChainTree", "at most 2,048 spheres, in a box that is mostly empty"},
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

/// Which share of the parts of the chain meet others than those beside them, by some spheres of each. Where
/// few do, a tree in the chain's order tells them apart, however unlike they are; where all do, that order
/// says nothing of where they lie.
double share_that_meets(std::span<const Sphere> spheres) {
  constexpr std::size_t parts = 16, some = 16;
  std::array<Box, parts> boxes;
  for (std::size_t k = 0; k < parts; ++k)
    for (std::size_t s = 0; s < some; ++s) {
      const Box box = Box::around(spheres[(k * some + s) * spheres.size() / (parts * some)]);
      s == 0 ? void(boxes[k] = box) : boxes[k].join(box);
    }
  std::size_t meet = 0, all = 0;
  for (std::size_t a = 0; a < parts; ++a)
    for (std::size_t b = a + 2; b < parts; ++b) meet += boxes[a].meets(boxes[b]), ++all;
  return static_cast<double>(meet) / static_cast<double>(all);
}

/// How much of a sphere, on average of some, is not within the next one along the chain.
double share_beside_the_next(std::span<const Sphere> spheres) {
  constexpr std::size_t some = 61;  // a prime: no period of the chain hides what there is
  double sum = 0;
  for (std::size_t k = 0; k < some; ++k) {
    const std::size_t i = k * (spheres.size() - 2) / (some - 1);
    const Sphere &a = spheres[i], &b = spheres[i + 1];
    const double step = std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z),
                 reach = double{a.radius} + b.radius;
    sum += step < reach ? step / reach : 1;
  }
  return sum / some;
}

}  // namespace

const UnusualKind* UnusualKind::of(std::uint32_t n, const Extent& extent, std::span<const Sphere> spheres) {
  // Measured over the registry's scenes and walks in boxes of any fill: these take 0.2 to 0.9 of the usual
  // variant's time.
  constexpr double widest = 0x1p60, sparse = 0.25, full = 0.2, dense = 6, very_dense = 10, few_meet = 0.5,
                   most_meet = 0.7;
  constexpr std::uint32_t few = 2048;  // no node of 128 spheres can meet so many others that it is crowded
  if (extent.greatest_radius > 0) {
    if (extent.least_radius > 0 && extent.greatest_radius > widest * extent.least_radius &&
        !spheres.empty() && share_that_meets(spheres) < few_meet)
      return &info(wide);
    if (extent.greatest_radius < std::numeric_limits<float>::min()) return &info(subnormal);
    const double filled = fill(n, extent);
    const bool like = extent.greatest_radius <= 2 * extent.least_radius;
    if (n <= few)
      return &info(filled <= sparse ? short_sparse : like && filled <= dense ? short_crowded : short_dense);
    if (like && filled > full && filled <= very_dense && spheres.size() > 1 &&
        filled * share_beside_the_next(spheres) > full && share_that_meets(spheres) > most_meet)
      return &info(crowded);
  }
  return nullptr;
}

}  // namespace catena
