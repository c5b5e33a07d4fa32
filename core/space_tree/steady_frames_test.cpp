#include "catena/core/space_tree/steady_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena {
namespace {

std::vector<Sphere> rod(std::uint32_t n) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < n; ++k) spheres.push_back({2.0f * static_cast<float>(k), 0, 0, 1});
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
}

TEST(SteadyFrames, EndWhereSpheresMoveByHalfARadiusOrGrowByIt) {
  for (const float by : {0.3f, 0.6f}) {
    const auto moved = [&](auto change) {
      std::vector<Sphere> spheres = rod(300);
      for (Sphere& s : spheres) change(s);
      return still(rod(300), spheres);
    };
    const bool little = by < 0.5f;
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
  EXPECT_FALSE(jump(1));
  EXPECT_FALSE(jump(5));
  EXPECT_TRUE(jump(1000));
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
}

}  // namespace
}  // namespace catena
