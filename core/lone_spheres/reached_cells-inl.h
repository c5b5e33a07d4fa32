// The cells that sixteen spheres reach.
#if defined(CATENA_CORE_LONE_SPHERES_REACHED_CELLS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_LONE_SPHERES_REACHED_CELLS_INL_H
#undef CATENA_CORE_LONE_SPHERES_REACHED_CELLS_INL_H
#else
#define CATENA_CORE_LONE_SPHERES_REACHED_CELLS_INL_H
#endif

#include <algorithm>
#include <cstdint>

#include "catena/core/blocks/transpose-inl.h"
#include "catena/core/lone_spheres/lone_cells.h"
#include "catena/core/lone_spheres/lone_map.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Coordinates of sixteen consecutive spheres, i and following; past `end`, the first again.
HWY_INLINE void take_sixteen(const ChainView& chain, std::uint32_t i, std::uint32_t end, Lanes16 (&at)[4]) {
  constexpr std::uint32_t size = 16;
  const Sphere* from = chain.spheres + i;
  Sphere copy[size];
  if (HWY_UNLIKELY(end - i < size)) {
    std::copy(from, from + (end - i), copy);
    std::fill(copy + (end - i), copy + size, copy[0]);
    from = copy;
  }
  transpose(&from->x, sizeof(Sphere) / sizeof(float), at);
}

/// See LoneCells.
class CellLanes {
 public:
  using Tag = Lanes16::Tag;
  using Bits = hn::RebindToUnsigned<Tag>;

  explicit HWY_INLINE CellLanes(const LoneCells& cells) : cells_(cells) {}
  /// In cells.
  HWY_INLINE hn::Vec<Tag> scaled(hn::Vec<Tag> v) const {
    return hn::Mul(v, hn::Set(Tag(), cells_.cells_per_unit));
  }
  static HWY_INLINE hn::Vec<Bits> cell(hn::Vec<Tag> at) {
    return hn::BitCast(Bits(), hn::ConvertTo(hn::RebindToSigned<Tag>(), hn::Floor(at)));
  }
  HWY_INLINE hn::Vec<Bits> rows(hn::Vec<Bits> y) const { return hn::Mul(y, hn::Set(Bits(), cells_.row)); }
  HWY_INLINE hn::Vec<Bits> layers(hn::Vec<Bits> z) const { return hn::Mul(z, hn::Set(Bits(), cells_.layer)); }
  HWY_INLINE hn::Vec<Bits> bit(hn::Vec<Bits> x, hn::Vec<Bits> rows, hn::Vec<Bits> layers) const {
    return hn::And(hn::Set(Bits(), cells_.bits - 1), hn::Add(x, hn::Add(rows, layers)));
  }

 private:
  const LoneCells& cells_;
};

/// The bits of the cells of sixteen spheres.
HWY_INLINE void own_bits(const ChainView& chain, const LoneCells& cells, std::uint32_t i, std::uint32_t end,
                         std::uint32_t (&to)[16]) {
  Lanes16 at[4];
  take_sixteen(chain, i, end, at);
  const CellLanes of(cells);
  const auto cell = [&](std::size_t d, std::size_t k) HWY_ATTR { return of.cell(of.scaled(at[d].part[k])); };
  for (std::size_t k = 0; k < Lanes16::parts; ++k)
    hn::StoreU(of.bit(cell(0, k), of.rows(cell(1, k)), of.layers(cell(2, k))), CellLanes::Bits(),
               to + k * Lanes16::width);
}

/// The cells that sixteen consecutive spheres reach.
class ReachedCells {
 public:
  static constexpr std::uint32_t size = 16;

  /// Spheres i and following, before `end`.
  HWY_INLINE void take(const ChainView& chain, const LoneCells& cells, std::uint32_t i, std::uint32_t end) {
    Lanes16 at[4];
    take_sixteen(chain, i, end, at);
    const CellLanes of(cells);
    for (std::uint32_t k = 0; k < Lanes16::parts; ++k) {
      const Axis x(of, at[0].part[k], cells.reach), y(of, at[1].part[k], cells.reach),
          z(of, at[2].part[k], cells.reach);
      const auto one = hn::Set(Bits(), 1);
      const std::uint32_t to = k * Lanes16::width;
      hn::StoreU(of.bit(x.low, of.rows(y.low), of.layers(z.low)), Bits(), first_ + to);
      hn::StoreU(of.bit(x.low, of.rows(y.own), of.layers(z.own)), Bits(), own_row_ + to);
      hn::StoreU(of.rows(y.further()), Bits(), to_row_ + to);
      hn::StoreU(of.layers(z.further()), Bits(), to_layer_ + to);
      hn::StoreU(hn::Add(one, hn::ShiftLeft<1>(x.further())), Bits(), along_x_ + to);
      hn::StoreU(hn::Add(one, hn::Sub(x.own, x.low)), Bits(), own_bit_ + to);
    }
  }

  /// Whether there is another one in the cells that sphere k reaches, as far as the map can tell.
  HWY_INLINE bool met(std::uint32_t k, const LoneCells& cells, const LoneMap& map) const {
    std::uint32_t some = map.several((own_row_[k] + own_bit_[k] - 1) & (cells.bits - 1));
    const std::uint32_t first = first_[k], to_row = to_row_[k], to_layer = to_layer_[k];
    for (const std::uint32_t to : {0u, to_row, to_layer, to_row + to_layer}) {
      const std::uint32_t bit = (first + to) & (cells.bits - 1);
      // In its own row the sphere meets itself.
      some |= map.two(bit) & along_x_[k] & ~(bit == own_row_[k] ? own_bit_[k] : 0);
    }
    return some != 0;
  }

 private:
  using Tag = CellLanes::Tag;
  using Bits = CellLanes::Bits;

  /// The cells of coordinates along one axis: their own, the first and the last that they reach.
  struct Axis {
    hn::Vec<Bits> own, low, high;
    HWY_INLINE Axis(const CellLanes& of, hn::Vec<Tag> v, float reach_of) {
      const auto at = of.scaled(v), reach = hn::Set(Tag(), reach_of);
      own = of.cell(at), low = of.cell(hn::Sub(at, reach)), high = of.cell(hn::Add(at, reach));
    }
    HWY_INLINE hn::Vec<Bits> further() const { return hn::Sub(high, low); }
  };

  alignas(64) std::uint32_t first_[size], own_row_[size], to_row_[size], to_layer_[size];
  alignas(64) std::uint32_t along_x_[size];  ///< 1, or 3 for two
  alignas(64) std::uint32_t own_bit_[size];  ///< of these
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
