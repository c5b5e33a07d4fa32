#pragma once
#include <array>
#include <cstdint>

#include "catena/core/vec3.h"

namespace catena {

/// The least side whose cube has at least n cells.
inline std::uint32_t side_of_cube(std::uint32_t n) {
  std::uint64_t side = 1;
  while (side * side * side < n) ++side;
  return static_cast<std::uint32_t>(side);
}

/// Cell i of a path through a cube of side^3 cells that runs to and fro along the first axis, then the
/// second, then the third: one step from cell to cell.
inline std::array<std::uint64_t, 3> serpentine_cell(std::uint64_t i, std::uint64_t side) {
  const std::uint64_t row = i / side, layer = row / side;
  return {row % 2 == 0 ? i % side : side - 1 - i % side, layer % 2 == 0 ? row % side : side - 1 - row % side,
          layer};
}

/// The point of a cell, the lattice's shortest step along each axis of the box: (1, 0, 0) on the cubic
/// lattice, (0, 1, 1) on the face-centred one. The box has its middle at the origin.
inline Vec3 serpentine_point(const std::array<std::uint64_t, 3>& cell, std::uint64_t side, bool face_centred) {
  const auto middle = static_cast<double>(side / 2);
  const double a = static_cast<double>(cell[0]) - middle, b = static_cast<double>(cell[1]) - middle,
               c = static_cast<double>(cell[2]) - middle;
  return face_centred ? Vec3{b + c, a + c, a + b} : Vec3{a, b, c};
}

}  // namespace catena
