// Eight spheres against eight, as many comparisons at a time as a vector has lanes.
#if defined(CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H
#undef CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H
#else
#define CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H
#endif

#include <bit>
#include <cstdint>
#include <cstring>

#include "catena/core/blocks/simd_targets.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/sphere.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The table of eight spheres against eight, in tiles: four columns wide, and as many rows high as a vector
/// holds groups of four lanes. So a row's numbers are spread within its group, which needs no memory, and
/// serve two tiles.
class SphereTiles {
 public:
  using Tag = hn::CappedTag<float, 16>;
  using Bits = hn::RebindToUnsigned<Tag>;
  using Mask = hn::Mask<Bits>;
  static constexpr std::uint32_t lanes = hn::MaxLanes(Tag()), columns = lanes < 4 ? 1 : 4,
                                 rows = lanes / columns, across = 8 / columns, count = 64 / lanes;

  /// The eight spheres of the columns.
  explicit HWY_INLINE SphereTiles(const Sphere* spheres) {
    for (std::uint32_t c = 0; c < across; ++c) columns_[c] = columns_of(spheres + c * columns);
  }

  /// What stage 1 of Robust says of a row's sphere and a column's: that they may overlap; and, of those that
  /// may, that binary32 leaves it open.
  struct Verdict {
    Mask may[count], open[count];
  };
  /// Of the eight spheres of the rows and those of the columns, where the column is further on than the row
  /// by more than `after`. Not less, rather than at most: a NaN of two infinities is neither, and may
  /// overlap.
  HWY_INLINE Verdict compare(const Sphere* spheres, std::int32_t after, float slack) const {
    const Tag tag;
    const Bits bits;
    const hn::RebindToSigned<Tag> whole;
    const auto all_slack = hn::Set(tag, slack), floor = hn::Set(tag, SphereLanes::overlap_floor);
    const auto nearest = hn::Set(whole, after);
    Verdict verdict;
    for (std::uint32_t t = 0; t < count; t += across) {
      const Fields row = rows_of(spheres + t / across * rows);
      for (std::uint32_t c = 0; c < across; ++c) {
        const Fields& column = columns_[c];
        const auto dx = hn::Sub(column.x, row.x), dy = hn::Sub(column.y, row.y),
                   dz = hn::Sub(column.z, row.z), reach = hn::Add(column.radius, row.radius),
                   q = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), of = hn::Mul(reach, reach);
        const auto apart = hn::Lt(hn::MulAdd(of, all_slack, floor), q),
                   certain = hn::Lt(hn::MulAdd(q, all_slack, floor), of);
        const auto later = hn::Gt(hn::BitCast(whole, hn::Sub(column_of(t + c), row_of(t + c))), nearest);
        verdict.may[t + c] = hn::AndNot(hn::RebindMask(bits, apart), hn::RebindMask(bits, later));
        verdict.open[t + c] = hn::AndNot(hn::RebindMask(bits, certain), verdict.may[t + c]);
      }
    }
    return verdict;
  }
  /// Without what is below the first rows and beyond the first columns.
  static HWY_INLINE void cut(std::uint32_t height, std::uint32_t breadth, Verdict& verdict) {
    const Bits bits;
    for (std::uint32_t t = 0; t < count; ++t) {
      const auto filled =
          hn::And(hn::Lt(row_of(t), hn::Set(bits, height)), hn::Lt(column_of(t), hn::Set(bits, breadth)));
      verdict.may[t] = hn::And(verdict.may[t], filled), verdict.open[t] = hn::And(verdict.open[t], filled);
    }
  }
  static HWY_INLINE bool none(const Mask (&mask)[count]) {
    Mask any = mask[0];
    for (std::uint32_t t = 1; t < count; ++t) any = hn::Or(any, mask[t]);
    return hn::AllFalse(Bits(), any);
  }

  /// The row, and the column, of each lane of tile t.
  static HWY_INLINE hn::Vec<Bits> row_of(std::uint32_t t) {
    alignas(64) static constexpr std::uint32_t within[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    return hn::Add(hn::Load(Bits(), within), hn::Set(Bits(), t / across * rows));
  }
  static HWY_INLINE hn::Vec<Bits> column_of(std::uint32_t t) {
    alignas(64) static constexpr std::uint32_t within[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
    return hn::Add(hn::Load(Bits(), within), hn::Set(Bits(), t % across * columns));
  }

 private:
  using Vec = hn::Vec<Tag>;
  struct Fields {
    Vec x, y, z, radius;
  };
  /// These spheres and the next, each in the lanes of its row.
  static HWY_INLINE Fields rows_of(const Sphere* r) {
#if HWY_TARGET != HWY_SCALAR
    const Vec v = hn::LoadU(Tag(), &r->x);
    return {hn::Broadcast<0>(v), hn::Broadcast<1>(v), hn::Broadcast<2>(v), hn::Broadcast<3>(v)};
#else
    return {hn::Set(Tag(), r->x), hn::Set(Tag(), r->y), hn::Set(Tag(), r->z), hn::Set(Tag(), r->radius)};
#endif
  }
  /// These spheres and the next, in every row.
  static HWY_INLINE Fields columns_of(const Sphere* c) {
#if HWY_TARGET <= HWY_AVX3
    alignas(64) static constexpr std::uint32_t every_fourth[4][16] = {
        {0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12, 0, 4, 8, 12},
        {1, 5, 9, 13, 1, 5, 9, 13, 1, 5, 9, 13, 1, 5, 9, 13},
        {2, 6, 10, 14, 2, 6, 10, 14, 2, 6, 10, 14, 2, 6, 10, 14},
        {3, 7, 11, 15, 3, 7, 11, 15, 3, 7, 11, 15, 3, 7, 11, 15}};
    const Vec v = hn::LoadU(Tag(), &c->x);
    const auto field = [&](std::uint32_t f) HWY_ATTR {
      return hn::TableLookupLanes(v, hn::IndicesFromVec(Tag(), hn::Load(Bits(), every_fourth[f])));
    };
    return {field(0), field(1), field(2), field(3)};
#elif HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const Vec v0 = hn::LoadDup128(tag, &c[0].x), v1 = hn::LoadDup128(tag, &c[1].x),
              v2 = hn::LoadDup128(tag, &c[2].x), v3 = hn::LoadDup128(tag, &c[3].x);
    const Vec xy02 = hn::InterleaveLower(tag, v0, v2), xy13 = hn::InterleaveLower(tag, v1, v3),
              zr02 = hn::InterleaveUpper(tag, v0, v2), zr13 = hn::InterleaveUpper(tag, v1, v3);
    return {hn::InterleaveLower(tag, xy02, xy13), hn::InterleaveUpper(tag, xy02, xy13),
            hn::InterleaveLower(tag, zr02, zr13), hn::InterleaveUpper(tag, zr02, zr13)};
#else
    return rows_of(c);
#endif
  }

  Fields columns_[across];
};

#if HWY_TARGET <= HWY_AVX3
static_assert(SphereTiles::lanes == 16);
/// Of tiles of sixteen: the row and the column of each lane, side by side; and a byte's bits, each twice.
struct PairsWithin {
  std::uint32_t of[128];
  std::uint16_t twice[256 + 3];
  constexpr PairsWithin() : of(), twice() {
    using T = SphereTiles;
    for (std::uint32_t k = 0; k < 64; ++k) {
      const std::uint32_t tile = k / T::lanes, lane = k % T::lanes;
      of[2 * k] = tile / T::across * T::rows + lane / T::columns;
      of[2 * k + 1] = tile % T::across * T::columns + lane % T::columns;
    }
    for (std::uint32_t byte = 0; byte < 256; ++byte)
      for (std::uint32_t k = 0; k < 8; ++k) twice[byte] |= (byte >> k & 1) * 3 << 2 * k;
  }
};
#endif

/// Which spheres of two blocks overlap, a byte or two a tile, until they are told.
struct MetTiles {
  static constexpr std::uint32_t bytes = (SphereTiles::lanes + 7) / 8;
  std::uint8_t bits[bytes * SphereTiles::count];
  /// The first sphere of the rows, and of the columns. Highway may read and write eight bytes for one of
  /// `bits`: they are set after these.
  std::uint32_t row, column;

  /// Whether there are any.
  HWY_INLINE bool set(const SphereTiles::Mask (&near)[SphereTiles::count]) {
    for (std::uint32_t t = 0; t < SphereTiles::count; ++t)
      hn::StoreMaskBits(SphereTiles::Bits(), near[t], bits + bytes * t);
    if constexpr (sizeof bits != sizeof(std::uint64_t)) return !SphereTiles::none(near);
    std::uint64_t all;
    std::memcpy(&all, bits, sizeof all);
    return all != 0;
  }
  /// Stores the pairs, and returns the place after the last. May write as many more as a vector has lanes.
  HWY_INLINE Pair* store(Pair* to) const {
    static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
#if HWY_TARGET <= HWY_AVX3
    // A pair is two lanes side by side, which stay or go together: Highway 1.0 copies a table to the stack
    // for each vector of 64 bits.
    const SphereTiles::Bits halves;
    alignas(64) static constexpr PairsWithin within;
    const auto first = hn::BitCast(halves, hn::Set(hn::Repartition<std::uint64_t, SphereTiles::Bits>(),
                                                   std::uint64_t{column} << 32 | row));
    for (std::uint32_t k = 0; k < 8; ++k) {
      const auto keep =
          hn::LoadMaskBits(halves, reinterpret_cast<const std::uint8_t*>(&within.twice[bits[k]]));
      hn::StoreU(hn::Compress(hn::Add(first, hn::Load(halves, within.of + 16 * k)), keep), halves, &to->i);
      to += std::popcount(bits[k]);
    }
#else
    const SphereTiles::Bits all;
    for (std::uint32_t t = 0; t < SphereTiles::count; ++t)
      if (bits[bytes * t] != 0)
        to += store_pairs(all, hn::Add(hn::Set(all, row), SphereTiles::row_of(t)),
                          hn::Add(hn::Set(all, column), SphereTiles::column_of(t)),
                          hn::LoadMaskBits(all, bits + bytes * t), to);
#endif
    return to;
  }
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
