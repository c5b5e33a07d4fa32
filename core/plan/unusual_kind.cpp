#include "catena/core/plan/unusual_kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "catena/core/blocks/squares_in_range.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/plan/row_look.h"
#include "catena/core/plan/slow_subnormals.h"

namespace catena {
namespace {

enum Kind {
  wide,
  subnormal,
  crowded,
  crowded_anywhere,
  short_extreme,
  short_smooth,
  short_apart,
  short_like,
  short_single,
  short_unlike,
  short_moving,
  kinds
};

const UnusualKind& info(Kind kind) {
  static const std::array<UnusualKind, kinds> all{{
      {"aCPU2+Dual", "radii of which one is more than 2^60 times another, in a chain whose parts lie apart"},
      {"Grid",
       "radii that are subnormal, with which other searches multiply, which this machine does slowly"},
      {"Grid", "spheres of like radii that fill their box, in a chain whose parts lie among one another",
       true, 6},
      {"Hybrid", "spheres of like radii that fill their box, in no order", true, 6},
      {"ChainTree", "at most 2,048 spheres in a box that is mostly empty, whose squares leave binary32"},
      {"ChainTree", "513 to 2,048 spheres of a smooth tube"},
      {"ChainTree", "at most 2,048 spheres, of which rows of eight are near few others"},
      {"Grid", "301 to 2,048 spheres of like radii, whose order tells little of what is near"},
      {"SphereTree",
       "at most 2,048 spheres in a small box, or at most 300 whose order tells little of what is near"},
      {"SphereTree",
       "at most 2,048 spheres that fill their box more than six times or have unlike radii, whose order "
       "tells "
       "little of what is near"},
      {"SphereTree",
       "301 to 2,048 spheres of like radii, whose order tells little of what is near, in frames: they are "
       "sorted in space for several at once"},
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

/// RowLook::straight of spheres that lie anywhere.
constexpr double anywhere = 0.25;
/// fill() of a box that is mostly empty.
constexpr double sparse = 0.25;

/// Of a few spheres, by how their rows of eight lie: where many are near one, a tree of these tells little
/// apart. Measured, with the limits below, over the registry's scenes and 69 other kinds of chain.
Kind short_kind(std::uint32_t n, double filled, bool like, std::span<const Sphere> spheres) {
  constexpr double few_rows = 6, spheres_a_row = 160, dense = 6, loose = 0.35, smooth = 0.98;
  constexpr double most_filled = 3, some_rows = 5;
  constexpr std::uint32_t very_few = 300, few = 512, many = 700;
  const RowLook look = RowLook::at(spheres);
  const bool apart = look.near <= std::min(few_rows, n / spheres_a_row) && look.straight > anywhere;
  if (!like || filled > dense) return apart ? short_apart : short_unlike;
  if (filled <= loose) return apart ? short_apart : n > very_few ? short_like : short_single;
  if (n > few) {
    // Blocks of a smooth tube are told apart by their capsules.
    const Course c = course(spheres);
    if (c.straight > smooth && filled * c.beside <= sparse) return short_smooth;
  }
  return n > many && look.near > some_rows && filled < most_filled && look.straight > anywhere ? short_like
                                                                                               : short_single;
}

}  // namespace

const UnusualKind* UnusualKind::of(std::uint32_t n, const Extent& extent, std::span<const Sphere> spheres,
                                   bool frames_follow) {
  // Measured over the registry's scenes and walks in boxes of any fill: these take 0.2 to 0.9 of the usual
  // variant's time.
  constexpr double widest = 0x1p60, full = 0.2, very_dense = 10;
  constexpr double few_meet = 0.5, most_meet = 0.7;
  constexpr std::uint32_t few = 2048;  // no node of 128 of them can meet so many others that it is crowded
  if (extent.greatest_radius > 0) {
    if (extent.least_radius > 0 && extent.greatest_radius > widest * extent.least_radius &&
        !spheres.empty() && share_that_meets(spheres) < few_meet)
      return &info(wide);
    if (extent.greatest_radius < std::numeric_limits<float>::min() && subnormals_are_slow())
      return &info(subnormal);
    const double filled = fill(n, extent);
    const bool like = extent.greatest_radius <= 2 * extent.least_radius;
    if (n <= few) {
      // The chain's order is the only one that scales its numbers.
      if (!squares_in_range(extent.greatest_radius) && filled <= sparse) return &info(short_extreme);
      if (spheres.empty()) return nullptr;
      const Kind kind = short_kind(n, filled, like, spheres);
      return &info(kind == short_like && frames_follow ? short_moving : kind);
    }
    if (like && filled > full && filled <= very_dense && filled * course(spheres).beside > full &&
        !spheres.empty() && share_that_meets(spheres) > most_meet)
      return &info(RowLook::at(spheres).straight > anywhere ? crowded : crowded_anywhere);
  }
  return nullptr;
}

}  // namespace catena
