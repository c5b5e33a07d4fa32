#include "catena/core/space_tree/steady_frames.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena {
namespace {

std::vector<Sphere> rod(std::uint32_t n, float radius = 1) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < n; ++k) spheres.push_back({2 * radius * static_cast<float>(k), 0, 0, radius});
  return spheres;
}

bool still(const std::vector<Sphere>& then, const std::vector<Sphere>& now) {
  SteadyFrames frames;
  frames.looked(Chain(then).view());
  return frames.still(Chain(now).view());
}

TEST(SteadyFrames, AreThoseOfWhichALookWasTaken) {
  SteadyFrames none;
  EXPECT_FALSE(none.still(Chain(rod(5)).view()));
  EXPECT_FALSE(none.still(Chain(rod(0)).view()));
  for (const std::uint32_t n : {1u, 2u, 63u, 64u, 65u, 1000u}) {
    EXPECT_TRUE(still(rod(n), rod(n))) << n;
    EXPECT_FALSE(still(rod(n), rod(n + 1))) << n;
  }
  SteadyFrames last;
  for (const std::uint32_t n : {100u, 50u}) last.looked(Chain(rod(n)).view());
  EXPECT_TRUE(last.still(Chain(rod(50)).view()));
  EXPECT_FALSE(last.still(Chain(rod(100)).view())) << "nor those of the look before";
}

TEST(SteadyFrames, EndWhereSpheresMoveByHalfARadiusOrGrowByIt) {
  for (const auto& [part, radius] : {std::pair(0.3f, 1.0f), {0.6f, 1.0f}, {0.3f, 8.0f}, {0.6f, 0.1f}}) {
    const auto moved = [radius = radius](auto change) {
      std::vector<Sphere> spheres = rod(300, radius);
      for (Sphere& s : spheres) change(s);
      return still(rod(300, radius), spheres);
    };
    const bool little = part < 0.5f;
    const float by = part * radius;
    EXPECT_EQ(moved([&](Sphere& s) { s.x += by; }), little) << by;
    EXPECT_EQ(moved([&](Sphere& s) { s.y -= by; }), little) << by;
    EXPECT_EQ(moved([&](Sphere& s) { s.z += by; }), little) << by;
    EXPECT_EQ(moved([&](Sphere& s) { s.radius += by; }), little) << by;
    EXPECT_EQ(moved([&](Sphere& s) { s.radius -= by; }), little) << by;
  }
}

TEST(SteadyFrames, EndWhereATenthGoesFar) {
  const auto jump = [](std::uint32_t one_in) {
    std::vector<Sphere> spheres = rod(2000);
    for (std::size_t k = 0; k < spheres.size(); ++k)
      if (k * 7919 % one_in == 0) spheres[k].y = 50;
    return still(rod(2000), spheres);
  };
  for (const std::uint32_t n : {1u, 2u, 15u, 16u}) {
    std::vector<Sphere> spheres = rod(n);
    spheres.back().y = 50;
    EXPECT_EQ(still(rod(n), spheres), n == 16) << "one of " << n << ", of which one in sixteen may";
  }
  EXPECT_FALSE(jump(1));
  EXPECT_FALSE(jump(5));
  EXPECT_TRUE(jump(1000));
  std::vector<Sphere> all_but_each_hundredth = rod(6400);
  for (std::size_t k = 0; k < all_but_each_hundredth.size(); ++k)
    if (k % 100 != 0) all_but_each_hundredth[k].y = 50;
  EXPECT_FALSE(still(rod(6400), all_but_each_hundredth)) << "whatever periods the chain has";
}

TEST(SteadyFrames, EndWhereLittleStepsHaveGoneFar) {
  SteadyFrames frames;
  std::vector<Sphere> spheres = rod(100);
  frames.looked(Chain(spheres).view());
  for (int step = 1; step < 4; ++step) {
    for (Sphere& s : spheres) s.z += 0.2f;
    EXPECT_EQ(frames.still(Chain(spheres).view()), step < 3) << step;
  }
}

TEST(SteadyFrames, EndAfterSixteen) {
  SteadyFrames frames;
  const Chain chain(rod(100));
  frames.looked(chain.view());
  int held = 0;
  while (held < 100 && frames.still(chain.view())) ++held;
  EXPECT_EQ(held, 16);
  frames.looked(chain.view());
  EXPECT_TRUE(frames.still(chain.view()));
}

TEST(SteadyFrames, OfPointsAreNone) {
  std::vector<Sphere> points = rod(50);
  for (Sphere& s : points) s.radius = 0;
  std::vector<Sphere> moved = points;
  for (Sphere& s : moved) s.x += 1;
  EXPECT_FALSE(still(points, moved));
  EXPECT_FALSE(still(points, points)) << "what moves by no radius is not known";
}

}  // namespace
}  // namespace catena
