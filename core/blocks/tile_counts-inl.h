// How many collisions each sphere has, where many have some: block by block rather than pair by pair.
#if defined(CATENA_CORE_BLOCKS_TILE_COUNTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_TILE_COUNTS_INL_H
#undef CATENA_CORE_BLOCKS_TILE_COUNTS_INL_H
#else
#define CATENA_CORE_BLOCKS_TILE_COUNTS_INL_H
#endif

#include <cstdint>
#include <cstring>

#include "catena/core/blocks/block_run-inl.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/sphere_tiles-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Adds to each of eight counts for the rows of a verdict, then for its columns, which may be the same, the
/// bits that are set of it.
HWY_INLINE void count_up_tile(std::uint64_t bits, std::uint32_t* of_rows, std::uint32_t* of_columns) {
  constexpr std::uint32_t block = 8;
  const std::uint64_t all = row_by_row(bits);
  std::uint64_t rows[block];
  std::uint8_t columns[block];
#if HWY_TARGET == HWY_SCALAR
  for (std::uint32_t k = 0; k < block; ++k) rows[k] = columns[k] = 0;
  for (std::uint32_t bit = 0; bit < 64; ++bit)
    if ((all >> bit & 1) != 0) ++rows[bit / block], ++columns[bit % block];
#else
  const hn::CappedTag<std::uint8_t, 64> bytes;
  const hn::Repartition<std::uint64_t, decltype(bytes)> eights;
  constexpr std::uint32_t lanes = hn::MaxLanes(bytes);
  auto sum = hn::Zero(eights);  // of up to eight bits a byte: none overflows
  for (std::uint32_t k = 0; k < 64; k += lanes) {
    std::uint8_t some[8];
    const std::uint64_t from_k = all >> k;
    std::memcpy(some, &from_k, sizeof some);
    const auto ones = hn::IfThenElseZero(hn::LoadMaskBits(bytes, some), hn::Set(bytes, 1));
    hn::StoreU(hn::SumsOf8(ones), eights, rows + k / block);
    sum = hn::Add(sum, hn::BitCast(eights, ones));
  }
  const std::uint64_t of_all = hn::GetLane(hn::SumOfLanes(eights, sum));
  std::memcpy(columns, &of_all, sizeof columns);
#endif
  for (std::uint32_t k = 0; k < block; ++k) of_rows[k] += static_cast<std::uint32_t>(rows[k]);
  for (std::uint32_t k = 0; k < block; ++k) of_columns[k] += columns[k];
}

/// Of what a BlockRun tells.
class RunCounts {
 public:
  void clear() { std::memset(of_, 0, sizeof of_); }
  /// Sphere i of `lanes` blocks collides with the one j after their first.
  HWY_INLINE void add(std::uint32_t i, std::uint32_t j, std::uint32_t lanes) {
    const hn::CappedTag<std::uint32_t, BlockRun::blocks> tag;
    for (std::uint32_t k = 0; k < BlockRun::blocks; k += hn::MaxLanes(tag)) {
      const auto one = hn::IfThenElseZero(lanes_of(tag, lanes >> k), hn::Set(tag, 1));
      for (std::uint32_t* const of : {of_[i] + k, of_[j] + k})
        hn::Store(hn::Add(hn::Load(tag, of), one), tag, of);
    }
  }
  /// Blocks begin with spheres `first`; the last has no next.
  void add_to(std::uint32_t* counts, const std::uint32_t (&first)[BlockRun::blocks],
              std::uint32_t lanes) const {
    constexpr std::uint32_t block = BlockRun::block;
    for_each_lane(lanes, [&](std::uint32_t k) {
      for (std::uint32_t p = 0; p < block; ++p)
        counts[first[k] + p] += of_[p][k] + (k > 0 ? of_[block + p][k - 1] : 0);
    });
  }

 private:
  alignas(64) std::uint32_t of_[2 * BlockRun::block][BlockRun::blocks];  ///< [place][block]
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
