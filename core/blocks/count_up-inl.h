// Lanes that count up.
#if defined(CATENA_CORE_BLOCKS_COUNT_UP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_COUNT_UP_INL_H
#undef CATENA_CORE_BLOCKS_COUNT_UP_INL_H
#else
#define CATENA_CORE_BLOCKS_COUNT_UP_INL_H
#endif

#include <cstdint>

#include "catena/core/blocks/simd_targets.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// first, first + 1, ... (Highway 1.0's Iota stores them one by one and waits for all to load them.)
template <class Bits>
HWY_INLINE hn::Vec<Bits> count_up(Bits bits, std::uint32_t first) {
  alignas(64) static constexpr std::uint32_t from_zero[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                              8, 9, 10, 11, 12, 13, 14, 15};
  static_assert(hn::MaxLanes(Bits()) <= 16);
  return hn::Add(hn::Set(bits, first), hn::Load(bits, from_zero));
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
