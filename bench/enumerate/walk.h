#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace catena::bench {

/// A walk on the square or cubic lattice from the origin, 3 bits a step; one of its class under the lattice's
/// symmetries: it enters each axis for the first time upwards, and the axes in their order.
struct Walk {
  static constexpr int most_steps = 20;  ///< 3 bits each in 60

  std::uint64_t steps = 0;     ///< bits 3k .. 3k+2: step k, 2 * axis + (downwards)
  std::uint8_t length = 0;     ///< number of steps
  std::uint8_t axes_used = 0;  ///< how many axes it has moved along

  int step(int k) const { return static_cast<int>(steps >> (3 * k) & 7); }
  /// The same with one more step.
  Walk then(int step) const;
  /// How many walks its class has on a lattice of so many dimensions: 1, 6, 24 or 48 on the cubic one.
  std::uint64_t images(int dimensions) const;
  /// Its length + 1 points.
  std::vector<std::array<int, 3>> points() const;
};

/// Calls visit for each walk that is this one and one more step, one of each class.
template <class Visit>
void for_each_extension(const Walk& walk, int dimensions, const Visit& visit) {
  for (int axis = 0; axis < walk.axes_used; ++axis)
    visit(walk.then(2 * axis)), visit(walk.then(2 * axis + 1));
  if (walk.axes_used < dimensions) visit(walk.then(2 * walk.axes_used));
}

}  // namespace catena::bench
