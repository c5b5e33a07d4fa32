#include "catena/core/hierarchy/box_around.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "catena/properties/testing/random_spheres.h"

namespace catena {
namespace {

using properties::random_spheres;

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
      const std::vector<Sphere> spheres = random_spheres(n, dice, greatest);
      Box box = Box::around(spheres[0]);
      for (const Sphere& s : spheres) box.join(Box::around(s));
      EXPECT_TRUE(equal(box_around(spheres), box)) << n << ' ' << greatest;
      const Box other = Box::around(random_spheres(1, dice, greatest)[0]);
      bool meets = false;
      for (const Sphere& s : spheres) meets = meets || Box::around(s).meets(other);
      EXPECT_EQ(MeetsBox(other).any_of(spheres), meets) << n << ' ' << greatest;
    }
}

}  // namespace
}  // namespace catena
