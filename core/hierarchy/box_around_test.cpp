#include "catena/core/hierarchy/box_around.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace catena {
namespace {

std::vector<Sphere> spheres_of(std::size_t n, std::mt19937& dice, float greatest) {
  std::uniform_real_distribution<float> at(-greatest, greatest),
      radius(0, greatest > 1e30f ? 1.9f * greatest : greatest / 8);
  std::vector<Sphere> spheres;
  for (std::size_t k = 0; k < n; ++k) spheres.push_back({at(dice), at(dice), at(dice), radius(dice)});
  return spheres;
}

bool equal(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.low[axis] != b.low[axis] || a.high[axis] != b.high[axis]) return false;
  return true;
}

/// Bit for bit the box of their boxes, so that what was proved of these holds; also where they end at
/// infinity.
TEST(BoxAround, IsTheBoxOfTheBoxesOfTheSpheres) {
  std::mt19937 dice(3);
  for (const float greatest : {1e-40f, 1e-3f, 1.0f, 1e20f, std::numeric_limits<float>::max() / 2.1f})
    for (std::size_t n = 1; n <= 70; ++n) {
      const std::vector<Sphere> spheres = spheres_of(n, dice, greatest);
      Box box = Box::around(spheres[0]);
      for (const Sphere& s : spheres) box.join(Box::around(s));
      EXPECT_TRUE(equal(box_around(spheres), box)) << n << ' ' << greatest;
      const Box other = Box::around(spheres_of(1, dice, greatest)[0]);
      bool meets = false;
      for (const Sphere& s : spheres) meets = meets || Box::around(s).meets(other);
      EXPECT_EQ(MeetsBox(other).any_of(spheres), meets) << n << ' ' << greatest;
    }
}

}  // namespace
}  // namespace catena
