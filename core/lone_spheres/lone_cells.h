#pragma once
#include <cstdint>
#include <optional>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"

namespace catena {

/// Cubes of space, the *cells*, in which a sphere is *alone* when no other one's centre lies in the cells
/// that it reaches: up to two along each axis, those of its centre's coordinate less and plus `reach`. What
/// overlaps it has its centre in one of these, so it has no collision. Each cell is a bit of a map: cell
/// (x, y, z) is bit (x + row y + layer z) mod `bits`, so two that follow one another along x are two bits in
/// a row. Cells that share a bit by chance leave a sphere that is alone among the others, and nothing else.
///
/// Coordinates are times cells_per_unit, in binary32 and below most_cells, and so are a sum and a difference
/// with `reach`: each wrong by 2^-8 of a cell at most. Of two spheres that overlap, `reach`, rounding_slack
/// above what their radii can bridge, outweighs that: properties/proofs/lone_cells.g.
struct CATENA_API LoneCells {
  static constexpr float rounding_slack = 0x1p-6f, most_cells = 0x1p16f;
  /// The sum of any two radii, in cells, at most.
  static constexpr double greatest_sum = 0.46;

  float cells_per_unit;
  float reach;
  std::uint32_t bits;  ///< a power of two
  std::uint32_t row, layer;

  /// For so many spheres; nothing where binary32 is too coarse for cells, or all is at one place.
  static std::optional<LoneCells> of(const Extent& extent, std::uint32_t spheres);

  /// The same in a map of at least so many bits.
  LoneCells of_bits(std::uint64_t bits) const;
};

}  // namespace catena
