// Pairs of spheres that binary32 leaves open, many at a time.
#if defined(CATENA_CORE_BLOCKS_OPEN_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_OPEN_PAIRS_INL_H
#undef CATENA_CORE_BLOCKS_OPEN_PAIRS_INL_H
#else
#define CATENA_CORE_BLOCKS_OPEN_PAIRS_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/exact_lanes-inl.h"
#include "catena/core/blocks/lanes-inl.h"
#include "catena/core/blocks/met_tiles-inl.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/chain/chain_view.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Collects them, as a chain of exact ties has one here and one there, and decides them: by binary64, a
/// vector of pairs at a time, and what that leaves open exactly, one by one.
class OpenPairs {
 public:
  static constexpr std::size_t most_lanes = 16;

  explicit OpenPairs(const ChainView& chain) : chain_(chain) {}

  /// Sphere i, or each lane of i, and the lanes of j that are open; once between two calls of full.
  template <class Bits, class I>
  HWY_INLINE void add(Bits bits, I i, hn::Vec<Bits> j, hn::Mask<Bits> open) {
    size_ += store_pairs(bits, i, j, open, pairs_.data() + size_);
  }
  void add(const MetTiles::Eight& eight) {
    size_ = static_cast<std::size_t>(store_pairs(eight, pairs_.data() + size_) - pairs_.data());
  }
  bool full() const { return size_ > limit; }
  std::size_t size() const { return size_; }

  /// Forgets them, and gives those that overlap, until the next call of add. Neighbours, which often touch,
  /// may be among them or not.
  HWY_NOINLINE std::span<Pair> decide() {
    std::array<Sphere, room> a, b;
    for (std::size_t k = 0; k < size_; ++k) {
      a[k] = chain_.spheres[pairs_[k].i];
      b[k] = chain_.spheres[pairs_[k].j];
    }
    for (std::size_t k = size_; k % pair_lanes != 0; ++k) a[k] = a[k - 1], b[k] = b[k - 1];
    std::size_t kept = 0;
    for (std::size_t begin = 0; begin < size_; begin += pair_lanes) {
      Told told = told_in_binary64(a.data() + begin, b.data() + begin);
      for (std::uint32_t left = told.open & lane_bits(static_cast<std::uint32_t>(size_ - begin)); left != 0;
           left &= left - 1)
        if (overlap(pairs_[begin + std::countr_zero(left)])) told.overlap |= left & (~left + 1);
      for (std::size_t k = begin; k < std::min(size_, begin + pair_lanes); ++k) {
        pairs_[kept] = pairs_[k];
        kept += told.overlap >> (k - begin) & 1;
      }
    }
    size_ = 0;
    return {pairs_.data(), kept};
  }

 private:
  static constexpr std::size_t limit = 64, room = limit + 2 * most_lanes;

  bool overlap(const Pair& pair) const {
    return !chain_.neighbours(pair.i, pair.j) &&
           Robust::overlap(chain_.spheres[pair.i], chain_.spheres[pair.j]);
  }

  const ChainView& chain_;
  std::size_t size_ = 0;
  std::array<Pair, room> pairs_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
