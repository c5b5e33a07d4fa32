#include "catena/core/frames/within.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "catena/core/arithmetic/exact_sign.h"
#include "catena/core/frames/near_pairs.h"

namespace catena {
namespace {

using Test = std::function<bool(const Sphere&, const Sphere&)>;

/// In exact arithmetic: |ca - cb| <= rb - ra.
bool exactly_within(const Sphere& a, const Sphere& b) {
  if (b.radius < a.radius) return false;
  // A point and a sphere of the radius rb - ra, which is what is asked where that difference has no error.
  const float room = b.radius - a.radius;
  EXPECT_EQ(double{b.radius} - a.radius, double{room}) << "a test of inexact rooms";
  return ExactSign::of_gap({a.x, a.y, a.z, 0}, {b.x, b.y, b.z, room}) <= 0;
}

/// Spheres that move from (x, y, z) by about their room: rounded to either side, at every magnitude.
std::vector<std::pair<Sphere, Sphere>> around_the_edge() {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<std::pair<Sphere, Sphere>> cases;
  for (int exponent = -140; exponent <= 120; ++exponent)
    for (int k = 0; k < 40; ++k) {
      const float room = std::ldexp(1.0f, exponent);
      float d[3] = {unit(random), unit(random), unit(random)};
      if (k % 4 == 0) d[1] = d[2] = 0;
      const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      Sphere a{0, 0, 0, k % 2 ? 0.0f : room}, b{0, 0, 0, a.radius + room};
      float* const to[] = {&a.x, &a.y, &a.z};
      for (int axis = 0; axis < 3; ++axis) *to[axis] = d[axis] / length * room;
      for (int step = -6; step <= 6; ++step) {
        Sphere moved = a;
        for (int s = 0; s < std::abs(step); ++s)
          moved.x = std::nextafter(
              moved.x, std::copysign(step < 0 ? 0.0f : std::numeric_limits<float>::max(), moved.x));
        cases.emplace_back(moved, b);
      }
      cases.emplace_back(Sphere{a.x * 0.5f, a.y * 0.5f, a.z * 0.5f, a.radius}, b);
    }
  return cases;
}

/// Spheres that are said to be within and are not.
std::size_t wrong(const Test& test) {
  std::size_t count = 0;
  for (const auto& [a, b] : around_the_edge()) count += test(a, b) && !exactly_within(a, b);
  return count;
}

TEST(Within, IsNeverSaidOfASphereThatIsNot) {
  EXPECT_EQ(wrong(within), 0u);
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(within({3e38f, 0, 0, 1}, {-3e38f, 0, 0, inf}));
  EXPECT_FALSE(within({0, 0, 0, 2}, {0, 0, 0, 1}));
  EXPECT_FALSE(within({0, 0, 0, 1}, {0, 0, 0, 1})) << "no room at all is for no list";
}

/// In vectors of eight, and one by one where fewer are left: with a skin that is the room, too, of points.
TEST(Within, IsNeverSaidOfRowsOfSpheresThatAreNot) {
  const auto in_rows_of = [](std::size_t size) {
    return [size](const Sphere& a, const Sphere& b) {
      const std::vector<Sphere> now(size, a), thick(size, b), before(size, Sphere{b.x, b.y, b.z, 0});
      const bool all = all_within(now, 0, thick);
      if (a.radius == 0) {
        EXPECT_EQ(all_near(now, before, b.radius), all) << b.radius;
      }
      return all;
    };
  };
  for (const std::size_t size : {1, 8, 9}) EXPECT_EQ(wrong(in_rows_of(size)), 0u) << size;
}

TEST(Within, IsSaidOfRowsWhereItIsOfEachSphere) {
  constexpr float skin = 0.25f;
  for (const std::size_t size : {0, 1, 7, 8, 9, 15, 16, 17, 521, 1033}) {
    const std::vector<Sphere> before(size, Sphere{1, 2, 3, 1}), now(size, Sphere{1.125f, 2, 3, 1}),
        thick(size, thicker({1, 2, 3, 1}, skin));
    EXPECT_TRUE(all_within(now, 0, thick)) << size;
    EXPECT_TRUE(all_within(now, 0.0625f, thick)) << size;
    EXPECT_TRUE(all_near(now, before, skin)) << size;
    for (std::size_t i = 0; i < size; i += i < 32 || i + 32 > size ? 1 : 31) {
      for (const Sphere& out : {Sphere{1, 2.5f, 3, 1}, Sphere{1, 2, 3, 1.5f}, Sphere{1, 2, 3, 0.5f}}) {
        std::vector<Sphere> spoilt = now;
        spoilt[i] = out;
        EXPECT_EQ(all_within(spoilt, 0, thick), out.radius < 1) << size << ' ' << i;
        EXPECT_FALSE(all_near(spoilt, before, skin)) << size << ' ' << i;
      }
    }
    if (size > 0) {
      EXPECT_FALSE(all_within(now, skin, thick)) << size;
    }
  }
}

TEST(Within, IsSaidOfWhatMovesByHalf) {
  for (float r : {1e-12f, 0.1f, 1.0f, 1e12f})
    EXPECT_TRUE(within({r, r, -r, r}, {1.5f * r, r, -r, 2 * r})) << r;
}

TEST(Within, WithItsRoundingDownTheTestSeesIt) {
  const auto rounded_down = [](const Sphere& a, const Sphere& b) {
    const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, m = b.radius - a.radius;
    return dx * dx + dy * dy + dz * dz <= m * m;
  };
  EXPECT_GT(wrong(rounded_down), 0u);
  EXPECT_GT(wrong([&](const Sphere& a, const Sphere& b) { return rounded_down(a, b) && b.radius < 1e15f; }),
            0u);
}

}  // namespace
}  // namespace catena
