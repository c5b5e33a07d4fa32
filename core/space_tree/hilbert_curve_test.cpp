#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "catena/core/space_tree/hilbert_curve-inl.h"

namespace catena {
namespace {

using HWY_NAMESPACE::HilbertCurve;

struct Cube {
  std::uint32_t x, y, z;
  static Cube number(std::uint32_t k, int levels) {
    const std::uint32_t side = 1u << levels;
    return {k % side, k / side % side, k / side / side};
  }
  std::uint32_t place(int levels) const { return HilbertCurve::place(x, y, z, levels); }
};
int apart(std::uint32_t a, std::uint32_t b) { return std::abs(static_cast<int>(a) - static_cast<int>(b)); }

TEST(HilbertCurve, StepsFromCubeToCubeThroughAll) {
  for (int levels = 1; levels <= 6; ++levels) {
    const std::uint32_t cubes = 1u << 3 * levels;
    std::vector<std::uint32_t> at(cubes, cubes);
    for (std::uint32_t k = 0; k < cubes; ++k) {
      const std::uint32_t place = Cube::number(k, levels).place(levels);
      ASSERT_LT(place, cubes);
      ASSERT_EQ(at[place], cubes) << "two cubes at place " << place;
      at[place] = k;
    }
    for (std::uint32_t place = 1; place < cubes; ++place) {
      const Cube a = Cube::number(at[place - 1], levels), b = Cube::number(at[place], levels);
      ASSERT_EQ(apart(a.x, b.x) + apart(a.y, b.y) + apart(a.z, b.z), 1)
          << levels << " levels, place " << place;
    }
  }
}

TEST(HilbertCurve, RefinesItself) {
  for (std::uint32_t k = 0; k < 1u << 18; ++k) {
    const Cube cube = Cube::number(k, 6);
    ASSERT_EQ(cube.place(6) >> 9, (Cube{cube.x >> 3, cube.y >> 3, cube.z >> 3}.place(3))) << k;
  }
}

TEST(HilbertCurve, StaysNearTenLevelsDeep) {
  // Along the curve one step of 1,024 in each axis's last bit: places of cubes that differ in it are of one
  // cube of the level above.
  for (std::uint32_t k = 0; k < 1u << 15; ++k) {
    const Cube cube{k * 37u % 1024, k * 101u % 1024, k * 211u % 1024};
    const std::uint32_t place = cube.place(10);
    ASSERT_LT(place, 1u << 30);
    ASSERT_EQ(place >> 3, (Cube{cube.x ^ 1u, cube.y, cube.z}.place(10) >> 3));
    ASSERT_NE(place, (Cube{cube.x ^ 1u, cube.y, cube.z}.place(10)));
  }
}

}  // namespace
}  // namespace catena
