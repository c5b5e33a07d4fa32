#pragma once
#include <cstdint>
#include <span>

#include "catena/core/hierarchy/morton_grid.h"

namespace catena {

/// What SpaceOrder sorts: spheres, x y z radius, or boxes, low x y z and high x y z; number k begins `stride`
/// floats after number k - 1. The middle of a box is looked at times two, its size is its greatest side; that
/// of a sphere is its radius.
struct SpaceRows {
  const float* first;
  std::size_t stride;
  bool boxes;
};

/// What middles and sizes are within.
struct SpaceExtent {
  CentreCorners middles;
  float greatest = 0;
  void join(const SpaceExtent& other);
};

/// Cubes, 512 along the longest side of a box of middles, and classes of size.
class SpaceGrid {
 public:
  /// Bits of a key: of the class, and of the place on Hilbert's curve of the cube, so many an axis.
  static constexpr int bits = 9, classes = 32;
  static constexpr float step = 8;  ///< from class to class, the greatest first

  /// Classes among those of this greatest size; 0: one class.
  SpaceGrid(const CentreCorners& middles, float greatest);

  /// All middles are one: it parts nothing but classes.
  bool is_point() const { return cubes == 0; }

  float low[3];    ///< times scale
  float scale;     ///< a power of two, with which nothing overflows
  float cubes;     ///< a unit of length, scaled; 0 for a point
  float greatest;  ///< size
};

/// What the middles and sizes of the entries are within, which are numbers in their lower halves. O(n).
SpaceExtent extent_of(const SpaceRows& rows, std::span<const std::uint64_t> entries);
/// Entries are numbers in their lower halves; the key of each comes to its upper half. O(n).
void make_keys(const SpaceRows& rows, const SpaceGrid& grid, std::span<std::uint64_t> entries);

}  // namespace catena
