// Pairs of one sphere and those of a vector that are kept.
#if defined(CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H
#undef CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H
#else
#define CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H
#endif

#include <cstdint>

#include "catena/core/blocks/compress-inl.h"
#include "catena/core/blocks/simd_targets.h"
#include "catena/core/pair.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// a and b of each of a vector's first `size` lanes, side by side. May write those of all lanes.
template <class Bits>
HWY_INLINE void store_side_by_side(Bits bits, hn::Vec<Bits> a, hn::Vec<Bits> b,
                                   [[maybe_unused]] std::uint32_t size, std::uint32_t* to) {
#if HWY_TARGET <= HWY_AVX3
  if constexpr (hn::MaxLanes(Bits()) == 16) {
    // Highway moves both halves by six shuffles; the second is mostly empty.
    alignas(64) static constexpr std::uint32_t twice[2][16] = {
        {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7},
        {8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13, 14, 14, 15, 15}};
    const auto half = [&](std::uint32_t k) HWY_ATTR {
      const auto lane = hn::IndicesFromVec(bits, hn::Load(bits, twice[k]));
      hn::StoreU(hn::OddEven(hn::TableLookupLanes(b, lane), hn::TableLookupLanes(a, lane)), bits,
                 to + 16 * k);
    };
    half(0);
    if (HWY_UNLIKELY(size > 8)) half(1);
    return;
  }
#endif
  hn::StoreInterleaved2(a, b, bits, to);
}

/// Stores pairs of i and the lanes of j that are kept, side by side, the lower index first; returns their
/// number. May write as many pairs as a vector has lanes.
template <class Bits>
HWY_INLINE std::uint32_t store_pairs(Bits bits, std::uint32_t i, hn::Vec<Bits> j, hn::Mask<Bits> keep,
                                     Pair* to) {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const Kept<Bits> lanes(keep);
  const auto kept = lanes.compress(j), all_i = hn::Set(bits, i);
  store_side_by_side(bits, hn::Min(all_i, kept), hn::Max(all_i, kept), lanes.size(), &to->i);
  return lanes.size();
}
/// Of each lane of i and its counterpart.
template <class Bits>
HWY_INLINE std::uint32_t store_pairs(Bits bits, hn::Vec<Bits> i, hn::Vec<Bits> j, hn::Mask<Bits> keep,
                                     Pair* to) {
  const Kept<Bits> lanes(keep);
  store_side_by_side(bits, lanes.compress(hn::Min(i, j)), lanes.compress(hn::Max(i, j)), lanes.size(),
                     &to->i);
  return lanes.size();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
