#include "catena/core/cells/fit_block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "catena/core/cells/host_warp.h"
#include "catena/core/cells/test_capsule.h"
#include "catena/reference/bounds.h"

namespace catena {
namespace {

using Block = std::array<Sphere, 64>;  // and the next one

/// Of a path that bends, or goes straight on.
Block some_block(std::mt19937& random, bool straight) {
  std::uniform_real_distribution<float> any(-1, 1);
  Block block;
  Vector32 at{20 * any(random), 20 * any(random), 20 * any(random)};
  const Vector32 ahead{any(random), any(random), 2};
  for (Sphere& s : block) {
    at = at + (straight ? ahead : Vector32{any(random), any(random), any(random)});
    s = {at.x, at.y, at.z, 0.5f + 0.4f * any(random)};
  }
  return block;
}
Block times(const Block& block, float scale) {
  Block result = block;
  for (Sphere& s : result) s = {s.x * scale, s.y * scale, s.z * scale, s.radius * scale};
  return result;
}
BlockShape fitted(const Block& block, bool own_units, std::uint32_t window = 1) {
  const auto at = [&](std::uint32_t k) { return block[k]; };
  return BlockFit(HostQuad(), at, window, own_units).shape();
}

/// In units of their own blocks have the same shape, however small they are; without, squares of the smallest
/// are 0.
TEST(BlockFit, InItsOwnUnitsIsTheSameAtAnySize) {
  std::mt19937 random(5);
  std::uint32_t ordered = 0;
  for (int round = 0; round < 200; ++round) {
    const Block block = some_block(random, round % 2 == 0);
    const std::uint32_t window = round % 4 < 2 ? 1 : 3;
    const BlockShape shape = fitted(block, false, window);
    ordered += shape.ordered;
    for (const int down : {0, 20, 40, 70, 95}) {
      const float scale = std::ldexp(1.0f, -down), up = std::ldexp(1.0f, down);
      const Block small = times(block, scale);
      const BlockShape own = fitted(small, true, window);
      EXPECT_EQ(own.ordered, shape.ordered) << down;
      EXPECT_NEAR(own.capsule.radius * up, shape.capsule.radius, 0x1p-20f * shape.capsule.reach) << down;
      EXPECT_NEAR(own.capsule.reach * up, shape.capsule.reach, 0x1p-20f * shape.capsule.reach) << down;
      for (std::uint32_t k = 0; k < 32; ++k)
        ASSERT_TRUE(reference::contains(promised(own.capsule), small[k])) << down << ' ' << k;
    }
  }
  EXPECT_GT(ordered, 20u);
  EXPECT_LT(ordered, 180u);
}

/// Points, and spheres at one place.
TEST(BlockFit, InItsOwnUnitsIsNoGreaterThanItsSpheres) {
  std::mt19937 random(8);
  for (const float scale : {1.0f, 0x1p-40f, 0x1p-90f}) {
    Block points = times(some_block(random, false), scale), together = points, nothing = points;
    for (Sphere& s : points) s.radius = 0;
    for (Sphere& s : together) s = {scale, scale, scale, 8 * s.radius};
    for (Sphere& s : nothing) s = {scale, scale, scale, 0};
    for (const Block& block : {points, together, nothing}) {
      const BlockCapsule capsule = fitted(block, true).capsule;
      for (std::uint32_t k = 0; k < 32; ++k)
        ASSERT_TRUE(reference::contains(promised(capsule), block[k])) << k;
      EXPECT_LT(capsule.reach, 40 * scale);
    }
    EXPECT_LT(fitted(together, true).capsule.reach, 8 * scale);
    EXPECT_LT(fitted(nothing, true).capsule.reach, 0x1p-118f);
  }
}

/// One after which far greater ones come, whose lengths overflow in its unit, is in no order.
TEST(BlockFit, InItsOwnUnitsIsNotOrderedBeforeWhatOverflowsThere) {
  std::mt19937 random(6);
  Block block = some_block(random, true);
  ASSERT_TRUE(fitted(block, true).ordered);
  const Block small = times(block, 0x1p-100f);
  for (std::uint32_t k = 32; k < 64; ++k)
    block[k] = {block[k].x * 0x1p30f, block[k].y * 0x1p30f, block[k].z * 0x1p30f, 0x1p30f};
  std::copy(small.begin(), small.begin() + 32, block.begin());
  const BlockShape shape = fitted(block, true);
  EXPECT_FALSE(shape.ordered);
  EXPECT_LT(shape.capsule.reach, 0x1p-92f);
}

}  // namespace
}  // namespace catena
