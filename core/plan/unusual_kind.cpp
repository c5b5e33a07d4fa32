#include "catena/core/plan/unusual_kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "catena/core/hierarchy/box.h"

namespace catena {
namespace {

enum Kind { wide, subnormal, crowded, short_crowded, short_dense, short_scattered, short_sparse };

const UnusualKind& info(Kind kind) {
  static const std::array<UnusualKind, 7> all{{
      {"aCPU2+Dual", "radii of which one is more than 2^60 times another, in a chain whose parts lie apart"},
      {"Grid", "radii that are subnormal, with which other searches multiply, at 150 cycles each"},
      {"Grid", "spheres of like radii that fill their box, in a chain whose parts lie among one another",
       true, 6},
      {"Grid",
       "at most 2,048 spheres of like radii, which fill a quarter of their box to six times all of it"},
      {"SphereTree", "at most 2,048 spheres, which fill their box more than six times or have unlike radii"},
      {"SphereTree",
       "at most 2,048 spheres, of which those that follow one another lie anywhere in their box"},
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

double distance(const Sphere& a, const Sphere& b) {
  const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

/// How the chain goes from sphere to sphere, by some of them.
struct Course {
  double beside;    ///< how much of a sphere is not within the next one: 1 of spheres that touch
  double straight;  ///< from a sphere to the seventh after it, of the way along the chain
};
Course course(std::span<const Sphere> spheres) {
  constexpr std::size_t some = 16, row = 8;
  if (spheres.size() < row) return {1, 0};
  double beside = 0, along = 0, across = 0;
  for (std::size_t k = 0; k < some; ++k) {
    const auto at = spheres.subspan(k * (spheres.size() - row) / (some - 1), row);
    beside += std::min(1.0, distance(at[0], at[1]) / (double{at[0].radius} + at[1].radius));
    for (std::size_t i = 1; i < row; ++i) along += distance(at[i - 1], at[i]);
    across += distance(at.front(), at.back());
  }
  return {beside / some, along > 0 ? across / along : 0};
}

/// Most spheres that follow one another at a distance of a block's lie apart by a good part of their box, by
/// some of them: then blocks in the chain's order lie among one another, and tell nothing apart.
bool scattered(const Extent& extent, std::span<const Sphere> spheres) {
  constexpr std::size_t some = 16, row = 8, few = 256, many = 512;
  constexpr double good_part = 0.2;
  if (spheres.size() < few) return false;  // in a small box all lie so, and it matters little
  std::size_t apart = 0;
  for (std::size_t k = 0; k < some; ++k) {
    const std::size_t i = k * (spheres.size() - row) / (some - 1);
    const Sphere &a = spheres[i], &b = spheres[i + row - 1];
    const double sides =
        std::abs(double{a.x} - b.x) + std::abs(double{a.y} - b.y) + std::abs(double{a.z} - b.z);
    apart += sides > good_part * extent.sides;
  }
  // Blocks that meet all others cost more the more there are.
  return apart >= (spheres.size() < many ? 13 : 11);
}

}  // namespace

const UnusualKind* UnusualKind::of(std::uint32_t n, const Extent& extent, std::span<const Sphere> spheres) {
  // Measured over the registry's scenes and walks in boxes of any fill: these take 0.2 to 0.9 of the usual
  // variant's time.
  constexpr double widest = 0x1p60, sparse = 0.25, full = 0.2, dense = 6, very_dense = 10;
  constexpr double few_meet = 0.5, most_meet = 0.7, smooth = 0.98;
  // No node of 128 spheres of a few can meet so many others that it is crowded; very few are searched before
  // it is seen how they lie.
  constexpr std::uint32_t few = 2048, very_few = 512;
  if (extent.greatest_radius > 0) {
    if (extent.least_radius > 0 && extent.greatest_radius > widest * extent.least_radius &&
        !spheres.empty() && share_that_meets(spheres) < few_meet)
      return &info(wide);
    if (extent.greatest_radius < std::numeric_limits<float>::min()) return &info(subnormal);
    const double filled = fill(n, extent);
    const bool like = extent.greatest_radius <= 2 * extent.least_radius;
    if (n <= few) {
      if (filled <= sparse) return &info(scattered(extent, spheres) ? short_scattered : short_sparse);
      if (!like || filled > dense) return &info(short_dense);
      if (n <= very_few) return &info(short_crowded);
      // Blocks of a smooth tube are told apart by their capsules.
      const Course c = course(spheres);
      return &info(c.straight > smooth && filled * c.beside <= sparse ? short_sparse : short_crowded);
    }
    if (like && filled > full && filled <= very_dense && filled * course(spheres).beside > full &&
        !spheres.empty() && share_that_meets(spheres) > most_meet)
      return &info(crowded);
  }
  return nullptr;
}

}  // namespace catena
