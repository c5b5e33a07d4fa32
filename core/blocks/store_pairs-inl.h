// Pairs of one sphere and those of a vector that are kept.
#if defined(CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H
#undef CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H
#else
#define CATENA_CORE_BLOCKS_STORE_PAIRS_INL_H
#endif

#include <bit>
#include <cstdint>

#include "catena/core/blocks/compress_table.h"
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
  hn::Vec<Bits> kept;
  std::size_t size;
  if constexpr (hn::MaxLanes(Bits()) ==
                8) {  // for which Highway 1.0 copies its table to the stack at each call
    std::uint8_t mask[8];
    hn::StoreMaskBits(bits, keep, mask);
    const hn::Rebind<std::uint8_t, Bits> bytes;
    const auto order = hn::PromoteTo(bits, hn::LoadU(bytes, compress_table[mask[0]].data()));
    kept = hn::TableLookupLanes(j, hn::IndicesFromVec(bits, order));
    size = static_cast<std::size_t>(std::popcount(mask[0]));
  } else {  // not CompressStore: to memory, AMD's instruction takes a hundred times as long
    kept = hn::Compress(j, keep);
    size = hn::CountTrue(bits, keep);
  }
  const auto all_i = hn::Set(bits, i);
  hn::StoreInterleaved2(hn::Min(all_i, kept), hn::Max(all_i, kept), bits, &to->i);
  return static_cast<std::uint32_t>(size);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
