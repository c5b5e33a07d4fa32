// What was said of pairs of blocks, until it is told which of their spheres it was.
#if defined(CATENA_CORE_BLOCKS_MET_TILES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_MET_TILES_INL_H
#undef CATENA_CORE_BLOCKS_MET_TILES_INL_H
#else
#define CATENA_CORE_BLOCKS_MET_TILES_INL_H
#endif

#include <bit>
#include <cstdint>
#include <cstring>

#include "catena/core/blocks/filled-inl.h"
#include "catena/core/blocks/sphere_tiles-inl.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/pair.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The row and the column of each bit of SphereTiles::Verdict, apart and side by side; and a byte's bits,
/// each twice. Highway may read eight bytes for two of these.
struct TilePairs {
  std::uint32_t rows[64], columns[64], both[128];
  std::uint16_t twice[256 + 3];
  constexpr TilePairs() : rows(), columns(), both(), twice() {
    for (std::uint32_t bit = 0; bit < 64; ++bit) {
      rows[bit] = both[2 * bit] = SphereTiles::row_of(bit);
      columns[bit] = both[2 * bit + 1] = SphereTiles::column_of(bit);
    }
    for (std::uint32_t byte = 0; byte < 256; ++byte)
      for (std::uint32_t k = 0; k < 8; ++k) twice[byte] |= (byte >> k & 1) * 3 << 2 * k;
  }
};
alignas(64) inline constexpr TilePairs tile_pairs;

/// Most blocks that are met have no spheres that overlap, and which have is hard to foretell: eight bits of
/// their verdicts are looked at where any is set, and found by vectors.
class MetTiles {
 public:
  static constexpr std::uint32_t most = 64, at_once = 8;

  /// Spheres from `row` and from `column` on, of two blocks.
  HWY_INLINE void add(std::uint32_t row, std::uint32_t column) { corners_[size_++] = {row, column}; }
  /// Of the k-th two that were added.
  HWY_INLINE void say(std::uint32_t k, const SphereTiles::Verdict& verdict) {
    overlap_[k] = verdict.overlap, open_[k] = verdict.open;
    any_open_ |= verdict.open;
  }
  std::uint32_t size() const { return size_; }
  /// Whether binary32 leaves any open.
  bool any_open() const { return any_open_ != 0; }
  void clear() { size_ = 0, any_open_ = 0; }

  /// Of the k-th two blocks: what overlaps, and from where on.
  std::uint64_t overlap(std::uint32_t k) const { return overlap_[k]; }
  const Pair& corner(std::uint32_t k) const { return corners_[k]; }

  /// Eight pairs of spheres of two blocks, of which some are meant.
  struct Eight {
    std::uint32_t row, column, first;  ///< bit of the verdict
    std::uint8_t bits;
  };
  /// Calls `visit` for what overlaps, or is open, of at_once pairs of blocks from `begin` on.
  template <class Visit>
  HWY_INLINE void for_overlap(std::uint32_t begin, Visit visit) const {
    for_each(overlap_, begin, visit);
  }
  template <class Visit>
  HWY_INLINE void for_open(std::uint32_t begin, Visit visit) const {
    for_each(open_, begin, visit);
  }

 private:
  template <class Visit>
  HWY_INLINE void for_each(const std::uint64_t (&verdicts)[most], std::uint32_t begin, Visit& visit) const {
    std::uint8_t bytes[8 * at_once];
    std::memcpy(bytes, verdicts + begin, sizeof bytes);
    const std::uint64_t beyond = begin + at_once > size_ ? ~std::uint64_t{0} << 8 * (size_ - begin) : 0;
    for (std::uint64_t left = filled(bytes) & ~beyond; left != 0; left &= left - 1) {
      const auto byte = static_cast<std::uint32_t>(std::countr_zero(left));
      const Pair& corner = corners_[begin + byte / 8];
      visit(Eight{corner.i, corner.j, 8 * (byte % 8), bytes[byte]});
    }
  }

  std::uint64_t overlap_[most] = {}, open_[most] = {};
  Pair corners_[most];
  std::uint32_t size_ = 0;
  std::uint64_t any_open_ = 0;
};

/// Stores these pairs, and returns the place after the last. May write as many more as a vector has lanes.
HWY_INLINE Pair* store_pairs(const MetTiles::Eight& eight, Pair* to) {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
#if HWY_TARGET <= HWY_AVX3
  // A pair is two lanes side by side, which stay or go together: Highway 1.0 copies a table to the stack for
  // each vector of 64 bits.
  const hn::CappedTag<std::uint32_t, 16> halves;
  const auto corner = hn::BitCast(halves, hn::Set(hn::Repartition<std::uint64_t, decltype(halves)>(),
                                                  std::uint64_t{eight.column} << 32 | eight.row));
  const auto keep =
      hn::LoadMaskBits(halves, reinterpret_cast<const std::uint8_t*>(&tile_pairs.twice[eight.bits]));
  const auto pairs = hn::Add(corner, hn::LoadU(halves, tile_pairs.both + 2 * eight.first));
  hn::StoreU(hn::Compress(pairs, keep), halves, &to->i);
  return to + std::popcount(eight.bits);
#else
  const hn::CappedTag<std::uint32_t, 8> bits;
  constexpr std::uint32_t lanes = hn::MaxLanes(bits);
  for (std::uint32_t k = 0; k < 8; k += lanes)
    to += store_pairs(
        bits, hn::Add(hn::Set(bits, eight.row), hn::LoadU(bits, tile_pairs.rows + eight.first + k)),
        hn::Add(hn::Set(bits, eight.column), hn::LoadU(bits, tile_pairs.columns + eight.first + k)),
        lanes_of(bits, eight.bits >> k & ((1u << lanes) - 1)), to);
  return to;
#endif
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
