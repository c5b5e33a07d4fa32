#include "catena/core/hierarchy/hilbert_curve.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace catena {
namespace {

std::uint32_t coordinate(std::uint32_t morton, int axis, int levels) {
  std::uint32_t value = 0;
  for (int l = 0; l < levels; ++l) value |= (morton >> (3 * l + 2 - axis) & 1) << l;
  return value;
}

TEST(HilbertCurve, StepsFromCubeToCubeThroughAll) {
  for (int levels = 1; levels <= 5; ++levels) {
    const std::uint32_t cubes = 1u << 3 * levels;
    std::vector<std::uint32_t> morton_at(cubes, cubes);
    for (std::uint32_t morton = 0; morton < cubes; ++morton) {
      const std::uint32_t place = HilbertCurve::place(morton, levels);
      ASSERT_LT(place, cubes);
      ASSERT_EQ(morton_at[place], cubes) << "two cubes at place " << place;
      morton_at[place] = morton;
    }
    for (std::uint32_t place = 1; place < cubes; ++place) {
      int steps = 0;
      for (int axis = 0; axis < 3; ++axis)
        steps += std::abs(static_cast<int>(coordinate(morton_at[place], axis, levels)) -
                          static_cast<int>(coordinate(morton_at[place - 1], axis, levels)));
      ASSERT_EQ(steps, 1) << levels << " levels, place " << place;
    }
  }
}

TEST(HilbertCurve, RefinesItself) {
  for (std::uint32_t morton = 0; morton < 1u << 12; ++morton)
    ASSERT_EQ(HilbertCurve::place(morton, 4) >> 6, HilbertCurve::place(morton >> 6, 2)) << morton;
}

}  // namespace
}  // namespace catena
