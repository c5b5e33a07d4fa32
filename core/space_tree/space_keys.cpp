// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/space_tree/space_keys.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <cmath>

#include "catena/core/space_tree/space_keys-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

SpaceExtent extent_of_here(const SpaceRows& rows, std::span<const std::uint64_t> entries) {
  return extent_of_middles(rows, entries);
}
void make_keys_here(const SpaceRows& rows, const SpaceGrid& grid, std::span<std::uint64_t> entries) {
  make_keys_of_middles(rows, grid, entries);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(extent_of_here);
HWY_EXPORT(make_keys_here);

SpaceExtent extent_of(const SpaceRows& rows, std::span<const std::uint64_t> entries) {
  return HWY_DYNAMIC_DISPATCH(extent_of_here)(rows, entries);
}
void make_keys(const SpaceRows& rows, const SpaceGrid& grid, std::span<std::uint64_t> entries) {
  HWY_DYNAMIC_DISPATCH(make_keys_here)(rows, grid, entries);
}

void SpaceExtent::join(const SpaceExtent& other) {
  middles.join(other.middles);
  greatest = std::max(greatest, other.greatest);
}

SpaceGrid::SpaceGrid(const CentreCorners& middles, float greatest_size) : greatest(greatest_size) {
  const float lows[3] = {middles.low.x, middles.low.y, middles.low.z},
              highs[3] = {middles.high.x, middles.high.y, middles.high.z};
  float farthest = 0, side = 0;
  for (std::size_t d = 0; d < 3; ++d) farthest = std::max({farthest, std::abs(lows[d]), std::abs(highs[d])});
  constexpr int much = 19, most = 126;  // 2^19 .. 2^20, and what binary32 has
  scale = farthest > 0 ? std::ldexp(1.0f, std::clamp(much - std::ilogb(farthest), -most, most)) : 1;
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = lows[d] * scale;
    side = std::max(side, highs[d] * scale - low[d]);
  }
  cubes = side > 0 ? static_cast<float>(1 << bits) / side : 0;
}

}  // namespace catena
#endif
