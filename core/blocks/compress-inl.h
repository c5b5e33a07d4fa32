// Lanes that are kept, moved to the front.
#if defined(CATENA_CORE_BLOCKS_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_COMPRESS_INL_H
#undef CATENA_CORE_BLOCKS_COMPRESS_INL_H
#else
#define CATENA_CORE_BLOCKS_COMPRESS_INL_H
#endif

#include <bit>
#include <cstdint>
#include <type_traits>

#include "catena/core/blocks/compress_table.h"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The lanes whose bits are set, of sixteen from bit 0 on.
template <class Bits>
HWY_INLINE hn::Mask<Bits> lanes_of(Bits bits, std::uint32_t lanes) {
  std::uint8_t bytes[8] = {static_cast<std::uint8_t>(lanes), static_cast<std::uint8_t>(lanes >> 8)};
  return hn::LoadMaskBits(bits, bytes);
}

/// Which lanes of 32-bit numbers are kept, for any number of vectors.
template <class Bits>
class Kept {
 public:
  explicit HWY_INLINE Kept(hn::Mask<Bits> keep) : keep_(keep) {
    // Of eight lanes, for which Highway 1.0 copies its table to the stack at each call.
    if constexpr (hn::MaxLanes(Bits()) == 8) {
      std::uint8_t mask[8];
      hn::StoreMaskBits(Bits(), keep, mask);
      const hn::Rebind<std::uint8_t, Bits> bytes;
      order_ = hn::PromoteTo(Bits(), hn::LoadU(bytes, compress_table[mask[0]].data()));
      size_ = static_cast<std::uint32_t>(std::popcount(mask[0]));
    } else {
      size_ = static_cast<std::uint32_t>(hn::CountTrue(Bits(), keep));
    }
  }
  std::uint32_t size() const { return size_; }
  /// The lanes that are kept, side by side. To a register: AMD's instruction takes a hundred times as long to
  /// memory.
  HWY_INLINE hn::Vec<Bits> compress(hn::Vec<Bits> v) const {
    if constexpr (hn::MaxLanes(Bits()) == 8)
      return hn::TableLookupLanes(v, hn::IndicesFromVec(Bits(), order_));
    else
      return hn::Compress(v, keep_);
  }

 private:
  struct None {};
  hn::Mask<Bits> keep_;
  std::conditional_t<hn::MaxLanes(Bits()) == 8, hn::Vec<Bits>, None> order_;
  std::uint32_t size_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
