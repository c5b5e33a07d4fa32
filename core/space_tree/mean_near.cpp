// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/space_tree/mean_near.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "catena/core/blocks/transpose-inl.h"
#include "catena/core/grid/bucket_map.h"
#include "catena/core/scattered.h"
#include "catena/core/space_tree/mean_near.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

namespace {

constexpr std::uint32_t lanes = 16;

/// The cells of a SphereGrid around that of a sphere.
struct CellsAround {
  float low[3], end[3];

  CellsAround() = default;
  CellsAround(const Sphere& s, float greatest_radius) {
    const double width = 2.0 * greatest_radius / (1 - BucketMap::cell_slack);
    const float at[3] = {s.x, s.y, s.z};
    for (std::size_t d = 0; d < 3; ++d) {
      const double before = std::floor(at[d] / width) - 1;
      low[d] = static_cast<float>(before * width);
      end[d] = static_cast<float>((before + 3) * width);
    }
  }
  Flags<lanes> have(const Lanes16 (&at)[4]) const {
    const auto along = [&](std::size_t d) HWY_ATTR {
      return (Lanes16::all(low[d]) <= at[d]) & (at[d] < Lanes16::all(end[d]));
    };
    return along(0) & along(1) & along(2);
  }
};

Flags<lanes> within_reach(const Sphere& s, const Lanes16 (&at)[4]) {
  Lanes16 far = at[3] + Lanes16::all(s.radius);
  return (abs(at[0] - Lanes16::all(s.x)) <= far) & (abs(at[1] - Lanes16::all(s.y)) <= far) &
         (abs(at[2] - Lanes16::all(s.z)) <= far);
}

}  // namespace

NearSpheres mean_near_here(const ChainView& chain, std::span<const std::uint32_t> of, float greatest_radius,
                           std::uint32_t parts) {
  constexpr std::uint32_t run = 4;  // spheres of a line of the cache
  // Of so many runs one is looked at, each time another of them: at even distances a chain that lies in rows
  // or turns would show the same part of each.
  const std::uint32_t runs = (chain.size + run - 1) / run, looks = (runs + parts - 1) / parts;
  const auto index = [&](std::uint32_t k) {
    const std::uint32_t look = k / run;
    return (look * parts + scattered(look + 1, parts)) * run + k % run;
  };
  std::array<CellsAround, most_samples> cells;
  std::transform(of.begin(), of.end(), cells.begin(),
                 [&](std::uint32_t i) { return CellsAround(chain.spheres[i], greatest_radius); });
  std::int64_t by_reach = 0, in_cells = 0;  // halves of pairs
  std::uint64_t looked_at = 0;
  // A sphere is near itself for certain, whether it is looked at or not.
  for (const std::uint32_t i : of) {
    const std::uint32_t look = i / run / parts;
    if (i / run % parts == scattered(look + 1, parts)) --by_reach, --in_cells;
  }
  for (std::uint32_t first = 0; first < looks * run; first += lanes) {
    std::uint32_t there = 0;
    for (std::uint32_t k = 0; k < lanes; ++k)
      there |= static_cast<std::uint32_t>(first + k < looks * run && index(first + k) < chain.size) << k;
    Lanes16 at[4];
    transpose_rows(
        [&](std::size_t k) {
          const auto lane = static_cast<std::uint32_t>(k);
          return &chain.spheres[there >> lane & 1 ? index(first + lane) : 0].x;
        },
        at);
    looked_at += static_cast<std::uint32_t>(std::popcount(there));
    for (std::size_t k = 0; k < of.size(); ++k) {
      const Sphere& s = chain.spheres[of[k]];
      const std::uint32_t within = within_reach(s, at).bits() & there;
      in_cells += std::popcount(cells[k].have(at).bits() & there);
      // Told by the smaller one, or half by each, so that a great one among many does not make the mean.
      Lanes16 radius = Lanes16::all(s.radius);
      by_reach +=
          std::popcount((radius < at[3]).bits() & within) + std::popcount((radius <= at[3]).bits() & within);
    }
  }
  const double times =
      static_cast<double>(chain.size) / static_cast<double>(looked_at) / static_cast<double>(of.size());
  const auto mean = [&](std::int64_t others) {
    return (static_cast<double>(std::max(others, std::int64_t{0})) * times + 1) / 2;
  };
  constexpr double in_reach = 1.5 * 1.5 * 1.5;
  return {in_reach * mean(by_reach), mean(in_cells)};
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(mean_near_here);

NearSpheres mean_near(const ChainView& chain, std::span<const std::uint32_t> of, float greatest_radius,
                      std::uint32_t parts) {
  return HWY_DYNAMIC_DISPATCH(mean_near_here)(chain, of, greatest_radius, parts);
}

}  // namespace catena
#endif
