// Which of 64 numbers are not 0.
#if defined(CATENA_CORE_BLOCKS_FILLED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_FILLED_INL_H
#undef CATENA_CORE_BLOCKS_FILLED_INL_H
#else
#define CATENA_CORE_BLOCKS_FILLED_INL_H
#endif

#include <cstdint>
#include <cstring>

#include "catena/core/blocks/simd_targets.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A bit for each of 64 numbers that is not 0, bytes or words of two.
template <class Number>
HWY_INLINE std::uint64_t filled(const Number* numbers) {
  const hn::CappedTag<Number, 64 / sizeof(Number)> tag;
  constexpr std::uint32_t lanes = hn::MaxLanes(tag);
  std::uint64_t all = 0;
  for (std::uint32_t k = 0; k < 64; k += lanes) {
    std::uint64_t some = 0;
    std::uint8_t bits[8];
    const std::size_t written =
        hn::StoreMaskBits(tag, hn::Ne(hn::LoadU(tag, numbers + k), hn::Zero(tag)), bits);
    std::memcpy(&some, bits, written);
    all |= some << k;
  }
  return all;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
