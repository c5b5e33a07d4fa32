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

/// Stores pairs of i and the lanes of j that are kept, side by side, the lower index first; returns their
/// number. May write as many pairs as a vector has lanes.
template <class Bits>
HWY_INLINE std::uint32_t store_pairs(Bits bits, std::uint32_t i, hn::Vec<Bits> j, hn::Mask<Bits> keep,
                                     Pair* to) {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const Kept<Bits> lanes(keep);
  const auto kept = lanes.compress(j);
  const auto all_i = hn::Set(bits, i);
  hn::StoreInterleaved2(hn::Min(all_i, kept), hn::Max(all_i, kept), bits, &to->i);
  return lanes.size();
}
/// Of each lane of i and its counterpart.
template <class Bits>
HWY_INLINE std::uint32_t store_pairs(Bits bits, hn::Vec<Bits> i, hn::Vec<Bits> j, hn::Mask<Bits> keep,
                                     Pair* to) {
  const Kept<Bits> lanes(keep);
  hn::StoreInterleaved2(lanes.compress(hn::Min(i, j)), lanes.compress(hn::Max(i, j)), bits, &to->i);
  return lanes.size();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
