// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/space_tree/mean_near.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <algorithm>
#include <bit>

#include "catena/core/blocks/transpose-inl.h"
#include "catena/core/space_tree/mean_near.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

double mean_near_here(const ChainView& chain, std::span<const std::uint32_t> of) {
  constexpr std::uint32_t lanes = 16, run = 4;  // spheres of a line of the cache
  // Of so many runs one is looked at; odd, so that no period of the chain's is likely to be met each time.
  const auto step = static_cast<std::uint32_t>(of.size() / 4 | 1);
  const std::uint32_t runs = (chain.size + run - 1) / run, looks = (runs + step - 1) / step;
  const auto index = [&](std::uint32_t k) { return k / run * step * run + k % run; };
  std::uint64_t halves = 0, looked_at = 0;
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
    for (const std::uint32_t i : of) {
      const Sphere& s = chain.spheres[i];
      const Lanes16 radius = Lanes16::all(s.radius), far = Lanes16::all(1.5f) * (at[3] + radius);
      const Flags<lanes> within = (abs(at[0] - Lanes16::all(s.x)) <= far) &
                                  (abs(at[1] - Lanes16::all(s.y)) <= far) &
                                  (abs(at[2] - Lanes16::all(s.z)) <= far);
      // Told by the smaller one, or half by each, so that a great one among many does not make the mean.
      const std::uint32_t greater = (radius < at[3]).bits() & within.bits() & there,
                          equal = (radius <= at[3]).bits() & within.bits() & there;
      halves += static_cast<std::uint32_t>(std::popcount(greater) + std::popcount(equal));
    }
  }
  return static_cast<double>(halves) * chain.size / static_cast<double>(looked_at) /
         static_cast<double>(2 * of.size());
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(mean_near_here);

double mean_near(const ChainView& chain, std::span<const std::uint32_t> of) {
  return HWY_DYNAMIC_DISPATCH(mean_near_here)(chain, of);
}

}  // namespace catena
#endif
