// Eight spheres against eight, as many comparisons at a time as a vector has lanes.
#if defined(CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H
#undef CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H
#else
#define CATENA_CORE_BLOCKS_SPHERE_TILES_INL_H
#endif

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/simd_targets.h"
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
  static constexpr std::uint32_t lanes = hn::MaxLanes(Tag()), columns = lanes < 4 ? 1 : 4,
                                 rows = lanes / columns, across = 8 / columns, count = 64 / lanes;

  /// The eight spheres of the columns.
  explicit HWY_INLINE SphereTiles(const Sphere* spheres) {
    for (std::uint32_t c = 0; c < across; ++c) columns_[c] = columns_of(spheres + c * columns);
  }

  /// What stage 1 of Robust says of a row's sphere and a column's: that they overlap, or that binary32 leaves
  /// it open. A bit for each two, those of a tile side by side.
  struct Verdict {
    std::uint64_t overlap, open;
    void keep(std::uint64_t bits) { overlap &= bits, open &= bits; }
  };
  /// Of the eight spheres of the rows and those of the columns. What is neither apart nor certain is open: so
  /// is a NaN of two infinities.
  HWY_INLINE Verdict compare(const Sphere* spheres, float slack) const {
    const Tag tag;
    const auto all_slack = hn::Set(tag, slack), floor = hn::Set(tag, Robust::underflow_floor);
    std::uint64_t all_apart = 0, all_certain = 0;
    for (std::uint32_t t = 0; t < count; t += across) {
      const Fields row = rows_of(spheres + t / across * rows);
      for (std::uint32_t c = 0; c < across; ++c) {
        const Fields& column = columns_[c];
        const auto dx = hn::Sub(column.x, row.x), dy = hn::Sub(column.y, row.y),
                   dz = hn::Sub(column.z, row.z), reach = hn::Add(column.radius, row.radius),
                   q = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz))), of = hn::Mul(reach, reach);
        all_apart |= bits_of(hn::Lt(hn::MulAdd(of, all_slack, floor), q)) << lanes * (t + c);
        all_certain |= bits_of(hn::Lt(hn::MulAdd(q, all_slack, floor), of)) << lanes * (t + c);
      }
    }
    return {all_certain, ~(all_apart | all_certain)};
  }

  /// Of a bit of Verdict.
  static constexpr std::uint32_t row_of(std::uint32_t bit) {
    return bit / lanes / across * rows + bit % lanes / columns;
  }
  static constexpr std::uint32_t column_of(std::uint32_t bit) {
    return bit / lanes % across * columns + bit % columns;
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

  static HWY_INLINE std::uint64_t bits_of(hn::Mask<Tag> mask) {
    std::uint8_t bytes[8];
    hn::StoreMaskBits(Tag(), mask, bytes);
    std::conditional_t<lanes == 16, std::uint16_t, std::uint8_t> bits;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
  }

  Fields columns_[across];
};

/// Of the bits of Verdict: those of a row side by side, a byte each.
inline std::uint64_t row_by_row(std::uint64_t bits) {
  const auto swap = [&](std::uint64_t lower, unsigned by) {
    const std::uint64_t change = (bits ^ bits >> by) & lower;
    bits ^= change | change << by;
  };
  if constexpr (SphereTiles::rows == 4) swap(0x0000FF000000FF00, 8);
  if constexpr (SphereTiles::rows >= 2 && SphereTiles::columns == 4) swap(0x00F000F000F000F0, 4);
  return bits;
}

/// Sets of bits of Verdict.
struct TileCuts {
  std::uint64_t later[17], rows[9], columns[9];
  constexpr TileCuts() : later(), rows(), columns() {
    for (std::uint32_t bit = 0; bit < 64; ++bit) {
      const std::uint64_t one = std::uint64_t{1} << bit;
      const std::uint32_t row = SphereTiles::row_of(bit), column = SphereTiles::column_of(bit);
      for (std::int32_t after = -8; after <= 8; ++after)
        if (static_cast<std::int32_t>(column - row) > after) later[after + 8] |= one;
      for (std::uint32_t size = 0; size <= 8; ++size) {
        if (row < size) rows[size] |= one;
        if (column < size) columns[size] |= one;
      }
    }
  }
};
inline constexpr TileCuts tile_cuts;
/// Where the column is further on than the row by more than `after`, from -8 to 8.
inline std::uint64_t later_than(std::int32_t after) { return tile_cuts.later[after + 8]; }
/// The first rows and columns.
inline std::uint64_t within_first(std::uint32_t rows, std::uint32_t columns) {
  return tile_cuts.rows[rows] & tile_cuts.columns[columns];
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
