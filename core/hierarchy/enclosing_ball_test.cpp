#include "catena/core/hierarchy/enclosing_ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/shapes.h"
#include "catena/reference/bounds.h"

namespace catena {
namespace {

using properties::Dice;

void expect_enclosed(const std::vector<Sphere>& spheres) {
  const Sphere ball = enclosing_ball(spheres);
  for (const Sphere& s : spheres)
    EXPECT_TRUE(reference::contains(Sphere64{ball.x, ball.y, ball.z, ball.radius}, s))
        << s.x << ' ' << s.y << ' ' << s.z << ' ' << s.radius << " of " << spheres.size();
}

TEST(EnclosingBall, EnclosesInExactArithmeticWhateverTheSpheres) {
  Dice dice(5);
  for (int k = 0; k < 2000; ++k) {
    std::vector<Sphere> spheres;
    const auto n = 1 + dice.below(20);
    const int exponent = dice.pick({0, 0, -140, 100, 126});
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto number = [&] {
        return dice.one_in(3) ? static_cast<float>(dice.between(-3, 3)) : dice.symmetric();
      };
      spheres.push_back({number(), number(), number(), std::fabs(number())});
    }
    properties::scale(spheres, exponent);
    expect_enclosed(spheres);
  }
}

TEST(EnclosingBall, EnclosesNumbersOfEveryExponent) {
  Dice dice(6);
  for (int k = 0; k < 1000; ++k) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < 6; ++i)
      spheres.push_back({properties::any_float(dice), properties::any_float(dice),
                         properties::any_float(dice), std::fabs(properties::any_float(dice))});
    expect_enclosed(spheres);
  }
}

TEST(EnclosingBall, IsTheSmallestWhereThatIsKnown) {
  // A regular tetrahedron of points, a triangle, two spheres, one in another, a cube with its middle.
  const std::vector<Sphere> tetrahedron{{1, 1, 1, 0}, {1, -1, -1, 0}, {-1, 1, -1, 0}, {-1, -1, 1, 0}};
  EXPECT_NEAR(enclosing_ball(tetrahedron).radius, std::sqrt(3.0), 1e-6);
  const std::vector<Sphere> triangle{{0, 0, 0, 1}, {4, 0, 0, 1}, {2, 1, 0, 1}};  // obtuse: two decide
  EXPECT_NEAR(enclosing_ball(triangle).radius, 3, 1e-6);
  const std::vector<Sphere> two{{0, 0, 0, 1}, {10, 0, 0, 3}};
  EXPECT_NEAR(enclosing_ball(two).radius, 7, 1e-5);
  EXPECT_NEAR(enclosing_ball(two).x, 6, 1e-5);
  const std::vector<Sphere> inside{{0, 0, 0, 5}, {1, 0, 0, 1}};
  EXPECT_EQ(enclosing_ball(inside).radius, std::nextafter(5.0f, 6.0f)) << "rounded up once";
  std::vector<Sphere> cube{{0, 0, 0, 0.5f}};
  for (int k = 0; k < 8; ++k)
    cube.push_back({k & 1 ? 1.0f : -1.0f, k & 2 ? 1.0f : -1.0f, k & 4 ? 1.0f : -1.0f, 0.25f});
  EXPECT_NEAR(enclosing_ball(cube).radius, std::sqrt(3.0) + 0.25, 1e-6);
}

/// A ball is the smallest when it cannot be moved: every direction has a sphere that it would leave.
TEST(EnclosingBall, CannotBeMadeSmallerByMovingIt) {
  Dice dice(7);
  for (int k = 0; k < 300; ++k) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < 12; ++i)
      spheres.push_back({dice.symmetric(), dice.symmetric(), dice.symmetric(), 0.3f * dice.unit()});
    const Sphere ball = enclosing_ball(spheres);
    const auto reach = [&](double x, double y, double z) {
      double most = 0;
      for (const Sphere& s : spheres) most = std::max(most, std::hypot(s.x - x, s.y - y, s.z - z) + s.radius);
      return most;
    };
    for (int d = 0; d < 50; ++d)
      EXPECT_GT(reach(ball.x + 1e-3 * dice.symmetric(), ball.y + 1e-3 * dice.symmetric(),
                      ball.z + 1e-3 * dice.symmetric()),
                ball.radius * (1 - 1e-6));
  }
}

}  // namespace
}  // namespace catena
