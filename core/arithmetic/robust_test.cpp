#include "catena/core/arithmetic/robust.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/reference/enclosure.h"

namespace catena {
namespace {

constexpr float denormal = std::numeric_limits<float>::denorm_min(),
                largest = std::numeric_limits<float>::max();

float ulps(float value, int steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, std::numeric_limits<float>::infinity());
  for (; steps < 0; ++steps) value = std::nextafter(value, -std::numeric_limits<float>::infinity());
  return value;
}

TEST(Robust, TouchingOverlapsAndOneUlpMoreDoesNot) {
  // 3-4-5 triangles at many scales: exactly representable, exactly touching.
  for (float scale : {0x1p-140f, 0x1p-100f, 0x1p-40f, 1.0f, 0x1p40f, 0x1p100f, 0x1p120f}) {
    const Sphere a{0, 0, 0, 2 * scale}, touching{3 * scale, 4 * scale, 0, 3 * scale};
    EXPECT_TRUE(Robust::overlap(a, touching)) << scale;
    EXPECT_TRUE(Robust::may_overlap(a, touching)) << scale;
    Sphere apart = touching;
    apart.x = ulps(apart.x, 1);
    EXPECT_FALSE(Robust::overlap(a, apart)) << scale;
    Sphere inside = touching;
    inside.radius = ulps(inside.radius, 1);
    EXPECT_TRUE(Robust::overlap(a, inside)) << scale;
  }
}

TEST(Robust, PointsOverlapOnlyThemselves) {
  const Sphere point{0, 0, 0, 0};
  EXPECT_TRUE(Robust::overlap(point, point));
  EXPECT_FALSE(Robust::overlap(point, {denormal, 0, 0, 0}));
  EXPECT_TRUE(Robust::overlap(point, {denormal, 0, 0, denormal}));
  EXPECT_FALSE(Robust::overlap(point, {2 * denormal, 0, 0, denormal}));
}

TEST(Robust, TheEndsOfTheRange) {
  EXPECT_TRUE(Robust::overlap({-largest, 0, 0, largest}, {largest, 0, 0, largest}));
  EXPECT_FALSE(Robust::overlap({-largest, 0, 0, largest}, {largest, denormal, 0, largest}));
  EXPECT_FALSE(Robust::overlap({-largest, -largest, -largest, 1}, {largest, largest, largest, 1}));
  EXPECT_TRUE(Robust::overlap({-largest, 0, 0, largest}, {0, 0, 0, denormal}));
}

/// Judged by the reference, in exact arithmetic. An infinite radius encloses everything, but may be given
/// only where no finite one can enclose both.
TEST(Robust, ParentsEncloseBothChildrenFromEndToEndOfTheRange) {
  const auto exactly = [](const Sphere& s) { return Sphere64{s.x, s.y, s.z, s.radius}; };
  const float values[] = {0, denormal, 1e-30f, 1, 0x1.000002p0f, 1e30f, largest, -largest};
  for (float x : values)
    for (float y : values)
      for (float ra : {0.0f, denormal, 1.0f, largest})
        for (float rb : {0.0f, denormal, 1.0f, largest}) {
          const Sphere a{x, 0, y, ra}, b{y, x, 0, rb}, parent = Robust::parent(a, b);
          EXPECT_TRUE(std::isfinite(parent.x) && std::isfinite(parent.y) && std::isfinite(parent.z));
          EXPECT_TRUE(reference::encloses(exactly(parent), exactly(a)))
              << x << ' ' << y << ' ' << ra << ' ' << rb;
          EXPECT_TRUE(reference::encloses(exactly(parent), exactly(b)))
              << x << ' ' << y << ' ' << ra << ' ' << rb;
          const float far = std::max({std::fabs(x), std::fabs(y), ra, rb});
          EXPECT_TRUE(far > largest / 8 || std::isfinite(parent.radius))
              << x << ' ' << y << ' ' << ra << ' ' << rb;
        }
}

TEST(Robust, AnInfiniteNodeIsNeverSkippedAndItsParentIsInfinite) {
  const Sphere everything{0, 0, 0, std::numeric_limits<float>::infinity()};
  EXPECT_TRUE(Robust::may_overlap({largest, largest, largest, 0}, everything));
  EXPECT_TRUE(std::isinf(Robust::parent(everything, {1, 2, 3, 4}).radius));
  EXPECT_TRUE(std::isinf(Robust::parent({1, 2, 3, 4}, everything).radius));
}

TEST(Robust, ParentOfCoincidentSpheresIsTheLargerOne) {
  const Sphere small{1, 2, 3, 1}, large{1, 2, 3, 5};
  EXPECT_EQ(Robust::parent(small, large), large);
  EXPECT_EQ(Robust::parent(large, small), large);
  EXPECT_EQ(Robust::parent(small, small), small);
}

TEST(Robust, InRangeSaysTheSameWithoutRangeChecks) {
  for (float scale : {0x1.8p-45f, 0x1p-20f, 1.0f, 0x1p20f, 0x1p57f}) {
    const Sphere a{0, 0, 0, 2 * scale};
    ASSERT_TRUE(Robust::in_range({2 * scale, 6 * scale})) << scale;
    for (int steps = -40; steps <= 40; ++steps)
      for (float radius : {3 * scale, 0.0f}) {
        const float x = radius == 0 ? 2 * scale : 3 * scale, y = radius == 0 ? 0 : 4 * scale;
        const Sphere b{ulps(x, steps), y, 0, radius};
        EXPECT_EQ(Robust::InRange::overlap(a, b), steps <= 0) << scale << " " << steps;
        EXPECT_EQ(Robust::overlap(a, b), steps <= 0) << scale << " " << steps;
        EXPECT_TRUE(steps > 0 || Robust::InRange::may_overlap(a, b)) << scale << " " << steps;
        EXPECT_FALSE(Robust::InRange::overlap_unless(true, a, b) || Robust::overlap_unless(true, a, b));
      }
    EXPECT_FALSE(Robust::InRange::may_overlap(a, {6.001f * scale, 0, 0, 4 * scale}));
    EXPECT_FALSE(Robust::InRange::may_overlap(a, {largest, largest, -largest, 4 * scale}));
  }
}

TEST(Robust, ExcessIsNegativeWhereSpheresMayOverlap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1, 1);
  int touching = 0;
  for (int k = 0; k < 20000; ++k) {
    const float scale = std::ldexp(1.0f, k % 90 - 40), far = k % 3 == 0 ? 1e3f : 1;
    const Sphere a{far * scale * any(random), scale * any(random), scale * any(random),
                   scale * (1.5f + any(random))};
    const float x = any(random), y = any(random), z = any(random), reach = 2 * a.radius / std::hypot(x, y, z);
    const auto at = [&](float part) {
      return Sphere{a.x + part * reach * x, a.y + part * reach * y, a.z + part * reach * z, a.radius};
    };
    const Sphere near = at(1), apart = at(far > 1 ? 1.1f : 1.0001f);
    touching += Robust::overlap(a, near);
    EXPECT_TRUE(!Robust::overlap(a, near) || Robust::InRange::excess(a, near) < 0) << k;
    EXPECT_TRUE(!Robust::overlap(a, near) || Robust::excess(a, near) < 0) << k;
    EXPECT_FALSE(Robust::InRange::excess(a, apart) < 0) << k;
    EXPECT_FALSE(Robust::excess(a, apart) < 0) << k;
  }
  EXPECT_GT(touching, 5000);  // about half, by rounding
  EXPECT_LT(Robust::InRange::excess({0, 0, 0, 1}, {2, 0, 0, 1}), 0);
  EXPECT_FALSE(Robust::InRange::excess({largest, largest, 0, 1}, {-largest, 0, largest, 1}) < 0);
}

TEST(Robust, OutOfRangeIsWhatStage1CannotDecide) {
  EXPECT_FALSE(Robust::in_range({0, 1}));
  EXPECT_FALSE(Robust::in_range({0x1p-45f, 1}));
  EXPECT_FALSE(Robust::in_range({1, 0x1p60f}));
  EXPECT_FALSE(Robust::in_range({1, std::numeric_limits<float>::infinity()}));
  EXPECT_TRUE(Robust::in_range({1, 1e6f}));
}

/// What the literal arithmetic must keep: the paper's flaws, so that they can be shown.
TEST(Literal, KeepsThePapersFlaws) {
  const Sphere same{1, 2, 3, 1};
  EXPECT_TRUE(std::isnan(Literal::parent(same, same).x)) << "0/0 for two equal spheres at one place";
  EXPECT_FALSE(Literal::overlap({0, 0, 0, 1e-30f}, {3e-30f, 0, 0, 1e-30f}) ==
               Robust::overlap({0, 0, 0, 1e-30f}, {3e-30f, 0, 0, 1e-30f}))
      << "squares underflow to 0 <= 0";
  EXPECT_FALSE(Literal::parent({-2e38f, 0, 0, 1}, {2e38f, 0, 0, 1}).radius <= largest)
      << "the square overflows";
}

TEST(Double, IsThePaperInBinary64) {
  const auto a = Double::bound({-2e38f, 0, 0, 1}), b = Double::bound({2e38f, 0, 0, 1});
  EXPECT_TRUE(std::isfinite(Double::parent(a, b).radius));
  EXPECT_TRUE(std::isnan(Double::parent(a, a).x)) << "the same formulas, the same 0/0";
}

}  // namespace
}  // namespace catena
