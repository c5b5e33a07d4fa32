#include "catena/core/plan/unusual_kind.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "catena/core/blocks/block_layout.h"
#include "catena/core/blocks/squares_in_range.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/never_destroyed.h"
#include "catena/core/plan/row_look.h"
#include "catena/core/scattered.h"

namespace catena {
namespace {

enum Kind {
  crowded,
  crowded_anywhere,
  short_extreme,
  short_horn,
  short_apart,
  short_dense,
  short_like,
  short_narrow,
  short_single,
  short_moving,
  short_points,
  short_points_anywhere,
  kinds
};

const UnusualKind& info(Kind kind) {
  static const auto& all = never_destroyed(std::array<UnusualKind, kinds>{{
      {"Grid", "spheres of like radii that fill their box, in a chain whose parts lie among one another",
       true, 6},
      {"Hybrid", "spheres of like radii that fill their box, in no order", true, 6},
      {"ChainTree",
       "at most 2,048 spheres whose squares leave binary32, in a box that is mostly empty or where this "
       "slows other searches"},
      {"SphereTree",
       "at most 2,048 spheres, of which those of one part have more than 2^140 times the radius of "
       "another's, or more than 2^60 and 2.8 times as much each row of eight"},
      {"ChainTree",
       "at most 6,000 spheres, of which rows of eight are near few others, or as many spheres are near each"},
      {"Grid",
       "301 to 6,000 spheres of like radii that fill their box, of which rows of eight are near many others"},
      {"Grid", "301 to 6,000 spheres of like radii in a box that is mostly empty, in no order"},
      {"Grid",
       "301 to 6,000 spheres of like radii, in no order or of which rows of eight are near many others, "
       "where vectors are narrower than AVX-512's"},
      {"SphereTree", "at most 6,000 spheres in no order, or of which rows of eight are near many others"},
      {"SphereTree",
       "301 to 2,048 spheres of like radii that cells would suit, in frames: they are sorted in space for "
       "several at once"},
      {"ChainTree", "at most 2,048 points that follow one another in space"},
      {"SphereTree", "at most 2,048 points in no order"},
  }});
  return all[kind];
}

/// About which share of the cube that is as wide as the chain, on average of three sides, cubes around the
/// spheres would fill.
double fill(std::uint32_t n, const Extent& extent) {
  const double width = 2.0 * extent.greatest_radius, side = extent.sides / 3 + width;
  const double cells = side > 0 ? side / width : 1;
  return n / (cells * cells * cells);
}

/// Which share of the parts of the chain meet others than those beside them, by some spheres of each: where
/// all do, its order says nothing of where they lie.
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

/// How many times the greatest radius of one part of the chain is that of another, by some spheres of each;
/// but for the greatest and the least of all. Few spheres that are unlike the others, or many among these,
/// make no difference.
double growth(std::span<const Sphere> spheres) {
  constexpr std::uint32_t parts = 16, some = 16;
  const auto n = static_cast<std::uint32_t>(spheres.size());
  std::array<float, parts> greatest{};
  for (std::uint32_t k = 0; k < parts * some; ++k) {
    const Sphere& s = spheres[sample_along(k, parts * some, n)];
    greatest[k / some] = std::max(greatest[k / some], s.radius);
  }
  std::ranges::sort(greatest);
  const double least = greatest[1];
  return least > 0 ? greatest[parts - 2] / least : 1;
}

/// Growth that may be too much for the chain's order.
constexpr double much_growth = 0x1p60;
/// So much that rows of eight tell little apart, or that no scale does for all.
bool grows_fast(double growth, std::uint32_t n) {
  constexpr double most = 0x1p140, a_row = 2.8, row = 8;
  return growth > most || (growth > much_growth && std::pow(growth, row / n) > a_row);
}

double distance(const Sphere& a, const Sphere& b) {
  const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
  return std::sqrt(x * x + y * y + z * z);
}

/// How much of a sphere is not within the next one, by some of them: 1 of spheres that touch.
double beside_the_next(std::span<const Sphere> spheres) {
  constexpr std::uint32_t some = 16;
  if (spheres.size() <= some) return 1;
  double beside = 0;
  for (std::uint32_t k = 0; k < some; ++k) {
    const auto at = sample_along(k, some, static_cast<std::uint32_t>(spheres.size() - 1));
    const Sphere &a = spheres[at], &b = spheres[at + 1];
    beside += std::min(1.0, distance(a, b) / (double{a.radius} + b.radius));
  }
  return beside / some;
}

std::span<const Sphere> all_of(const ChainView& chain) { return {chain.spheres, chain.size}; }

RowLook look_at_rows(const ChainView& chain, double asked) {
  if (chain.strand_count < 2) return RowLook::at(all_of(chain), asked);
  return RowLook::at(all_of(chain), asked, {chain.exclusion.strand_first, chain.strand_count + 1});
}

/// RowLook::straight of spheres that lie anywhere.
constexpr double anywhere = 0.25;
/// fill() of a box that is mostly empty.
constexpr double sparse = 0.25;

/// Of a few spheres that are to be searched one by one. A tree of these needs no like ones, and finds sooner
/// where nothing is; with wide vectors, too, where it depends.
Kind kind_of_single(std::uint32_t n, double filled, bool like, bool ordered) {
  constexpr double dense = 3;
  constexpr std::uint32_t very_few = 300;
  if (!like || n <= very_few || filled > dense) return short_single;
  if ((filled > sparse) != ordered) return wide_vectors() ? short_single : short_narrow;
  return ordered ? short_dense : short_like;
}

/// Of a few spheres, by how their rows of eight lie: a tree of these takes longer the more of them are near
/// one, other variants the more spheres are near one, along a tube of overlapping ones too. Measured over the
/// registry's scenes and 30 other kinds of chain, of fifteen sizes each.
Kind short_kind(const ChainView& chain, double filled, bool like) {
  // With wide vectors most_rows would be 24 on a Zen 5, and 12 on a Xeon of its time.
  constexpr double least_rows = 2, most_rows = 18, least_beside = 1. / 128;
  if (blocks_half_empty(chain)) return kind_of_single(chain.size, filled, like, false);
  RowLook look = look_at_rows(chain, most_rows);
  const double order = std::clamp(look.straight / anywhere - 1, 0.0, 1.0);
  double rows = least_rows + order * (most_rows - least_rows);
  if (order > 0 && look.near > rows) {
    rows /= std::max(beside_the_next(all_of(chain)), least_beside);
    look = look_at_rows(chain, rows);
  }
  return look.near <= rows ? short_apart : kind_of_single(chain.size, filled, like, order > 0);
}

}  // namespace

const UnusualKind* UnusualKind::of(const ChainView& chain, bool frames_follow) {
  // Measured over the registry's scenes and walks in boxes of any fill: these take 0.2 to 0.9 of the usual
  // variant's time.
  constexpr double full = 0.2, very_dense = 10, most_meet = 0.7;
  constexpr std::uint32_t few = 2048;  // no node of 128 of them can meet so many others that it is crowded
  // Of more two dozen rows tell too little, and nodes of many strands meet more than rows do.
  constexpr std::uint32_t some = 6000, short_strand = 32;
  const std::uint32_t n = chain.size;
  const Extent& extent = chain.extent;
  const bool placed = chain.spheres != nullptr;  // or where they lie is not known
  if (extent.greatest_radius > 0) {
    const double filled = fill(n, extent);
    const bool like = extent.greatest_radius <= 2 * extent.least_radius,
               slow_alone = single_spheres_share(extent) > 1;
    const bool unlike = extent.greatest_radius > much_growth * extent.least_radius;
    if (n <= few) {
      if (unlike && placed && grows_fast(growth(all_of(chain)), n)) return &info(short_horn);
      // The chain's order scales its numbers once, others with each look at them.
      if (!squares_in_range(extent.greatest_radius) && (filled <= sparse || slow_alone))
        return &info(short_extreme);
      if (!placed) return nullptr;
      const Kind kind = short_kind(chain, filled, like);
      const bool cells = kind == short_like || kind == short_dense || kind == short_narrow;
      return &info(cells && frames_follow ? short_moving : kind);
    }
    // In frames the usual variant looks once for many.
    const bool by_rows = n <= some && n >= std::uint64_t{short_strand} * chain.strand_count && !frames_follow;
    if (by_rows && placed && !unlike && !slow_alone && squares_in_range(extent.greatest_radius))
      return &info(short_kind(chain, filled, like));
    if (like && !slow_alone && filled > full && filled <= very_dense && placed &&
        filled * beside_the_next(all_of(chain)) > full && share_that_meets(all_of(chain)) > most_meet)
      return &info(look_at_rows(chain, 0).straight > anywhere ? crowded : crowded_anywhere);
  } else if (n <= few && extent.sides > 0 && placed) {
    return &info(look_at_rows(chain, 0).straight > anywhere ? short_points : short_points_anywhere);
  }
  return nullptr;
}

}  // namespace catena
