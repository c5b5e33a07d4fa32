#include "catena/core/hierarchy/radius_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/chain/chain.h"

namespace catena {
namespace {

RadiusRange range_of(const std::vector<Sphere>& spheres) {
  return radius_range(Chain(spheres).view().extent);
}

/// What lets a search leave out its range checks.
TEST(RadiusRange, HoldsForEveryTreeOverTheChain) {
  std::mt19937 random(1);
  for (const float scale : {0x1p-40f, 1.0f, 0x1p40f, 0x1p100f})
    for (const float spread : {0.0f, 0.1f, 1e6f}) {
      std::uniform_real_distribution<float> place(-spread * scale, spread * scale),
          radius(0.5f * scale, scale);
      std::vector<Sphere> level(500);
      for (Sphere& s : level) s = {place(random), place(random), place(random), radius(random)};
      const RadiusRange radii = range_of(level);
      EXPECT_EQ(radii.least, std::ranges::min(level, {}, &Sphere::radius).radius);
      for (; level.size() > 1; level.resize((level.size() + 1) / 2)) {
        for (const Sphere& s : level) EXPECT_GE(radii.reach, 2 * s.radius) << scale << " " << spread;
        for (std::size_t i = 0; i < level.size(); i += 2)
          level[i / 2] = i + 1 < level.size() ? Robust::parent(level[i], level[i + 1]) : level[i];
      }
    }
}

TEST(RadiusRange, IsFourTimesTheGreatestRadiusAndTheSidesOfEveryLevel) {
  const RadiusRange radii = range_of({{0, 0, 0, 2}, {1, -2, 4, 3}});
  EXPECT_EQ(radii.least, 2);
  EXPECT_EQ(radii.reach, 4 * (3 + max_hierarchy_height * 7.0));
  EXPECT_EQ(range_of({{-3e38f, 0, 0, 0}, {3e38f, 0, 0, 0}}).reach, std::numeric_limits<float>::infinity());
  EXPECT_EQ(range_of({}).least, 0);
  EXPECT_EQ(range_of({}).reach, 0);
}

}  // namespace
}  // namespace catena
