#include "catena/core/cells/block_capsule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "catena/core/cells/test_capsule.h"
#include "catena/reference/bounds.h"

namespace catena {
namespace {

/// Thin or thick, long or a ball.
BlockCapsule some_capsule(std::mt19937& random) {
  std::uniform_real_distribution<float> any(-1, 1);
  BlockCapsule c{};
  c.centre = {any(random), any(random), any(random)};
  if (any(random) > -0.7f) c.half = {any(random), any(random), any(random)};
  const float square = dot(c.half, c.half);
  c.radius = BlockCapsule::with_slack(std::ldexp(1.0f, static_cast<int>(5 * any(random)) - 4), square);
  c.reach = std::sqrt(square) + c.radius;
  return c;
}
BlockCapsule times(float scale, const BlockCapsule& c) {
  return {scale * c.centre, scale * c.radius, scale * c.half, scale * c.reach};
}

/// In units of their own two capsules are as separate as the same two at any other size, and only where they
/// are in exact arithmetic.
TEST(BlockCapsule, InUnitsOfTheirOwnTwoAreAsSeparateAtAnySize) {
  std::mt19937 random(7);
  std::uint32_t pairs = 0, apart = 0, balls_apart = 0;
  for (; pairs < 3000; ++pairs) {
    const BlockCapsule a = some_capsule(random), b = some_capsule(random);
    const bool are = separate(a, b, false), far = far_apart(ball_of(a), ball_of(b), false);
    apart += are, balls_apart += far;
    for (const int down : {-20, 0, 30, 60, 100}) {
      const float scale = std::ldexp(1.0f, -down);
      const BlockCapsule p = times(scale, a), q = times(scale, b);
      EXPECT_EQ(separate(p, q, true), are) << down;
      EXPECT_EQ(far_apart(ball_of(p), ball_of(q), true), far) << down;
      if (are || far) {
        ASSERT_TRUE(reference::separate(promised(p), promised(q))) << down;
      }
    }
  }
  EXPECT_GT(apart, pairs / 4);
  EXPECT_GT(balls_apart, pairs / 8);
  EXPECT_LT(apart, pairs * 9 / 10);
}

/// Far smaller capsules beside one another, of which either the squares are lost or all is.
TEST(BlockCapsule, InUnitsOfTheirOwnOneTouchesWhatIsFarSmaller) {
  const BlockCapsule great = BlockCapsule::around({0, 0, 0, 1}, true);
  for (const float radius : {0.0f, 0x1p-149f, 0x1p-126f, 0x1p-100f, 0x1p-60f}) {
    for (const float at : {0.0f, 0x1p-149f, 0x1p-70f, 0.5f, 1.0f}) {
      const BlockCapsule small = BlockCapsule::around({at, 0, 0, radius}, true);
      EXPECT_FALSE(separate(great, small, true)) << radius << ' ' << at;
      EXPECT_FALSE(far_apart(ball_of(small), ball_of(great), true)) << radius << ' ' << at;
    }
    const BlockCapsule away = BlockCapsule::around({1.001f, 0, 0, radius}, true);
    EXPECT_TRUE(separate(great, away, true)) << radius;
    EXPECT_TRUE(far_apart(ball_of(away), ball_of(great), true)) << radius;
    const BlockCapsule other = BlockCapsule::around({1, 0, 0, radius}, true);
    EXPECT_TRUE(separate(away, other, true)) << radius;
    EXPECT_TRUE(far_apart(ball_of(away), ball_of(other), true)) << radius;
  }
  // What a number loses where a chain is scaled.
  EXPECT_GT(BlockCapsule::around({0, 0, 0, 0}, true).radius, 4 * 0x1p-149f);
  // Squares that are rounded to multiples of the least number say that these are apart.
  const float side = 0.8f * 0x1p-75f;
  const Sphere a{0, 0, 0, side * 0.9f}, b{side, side, side, side * 0.9f};
  EXPECT_FALSE(
      far_apart(ball_of(BlockCapsule::around(a, true)), ball_of(BlockCapsule::around(b, true)), true));
  EXPECT_FALSE(separate(BlockCapsule::around(a, true), BlockCapsule::around(b, true), true));
}

TEST(BlockCapsule, AUnitBringsALengthToBetweenOneAndTwo) {
  for (const float length : {0x1p-126f, 0x1.8p-126f, 0x1p-60f, 0.75f, 1.0f, 1.999f, 2.0f, 0x1.fp20f}) {
    EXPECT_GE(length * unit_of(length), 1) << length;
    EXPECT_LT(length * unit_of(length), 2) << length;
  }
  EXPECT_EQ(unit_of(0), 0x1p127f);
  EXPECT_LT(0x1p-127f * unit_of(0x1p-127f), 2);
}

}  // namespace
}  // namespace catena
