#pragma once
#include <array>
#include <cstdint>

namespace catena {

/// The least side whose cube has at least n cells.
inline std::uint32_t side_of_cube(std::uint32_t n) {
  std::uint64_t side = 1;
  while (side * side * side < n) ++side;
  return static_cast<std::uint32_t>(side);
}

/// Cell i of a path through a cube of side^3 cells that runs to and fro along the first axis, then the
/// second, then the third: one step from cell to cell.
inline std::array<std::uint32_t, 3> serpentine_cell(std::uint32_t i, std::uint32_t side) {
  const std::uint32_t row = i / side, layer = row / side;
  return {row % 2 == 0 ? i % side : side - 1 - i % side, layer % 2 == 0 ? row % side : side - 1 - row % side,
          layer};
}

}  // namespace catena
