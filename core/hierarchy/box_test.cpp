#include "catena/core/hierarchy/box.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "catena/reference/testing/nasty.h"

namespace catena {
namespace {

/// The sign of low - (centre - radius) in exact arithmetic: both of the sum's two parts are exact in
/// binary64.
int above(float low, float centre, float radius) {
  const double sum = double{centre} - radius, back = sum - centre;
  const double error = (centre - (sum - back)) - (radius + back);
  return low > sum || (low == sum && error < 0) ? 1 : low == sum && error == 0 ? 0 : -1;
}

RC_GTEST_PROP(Box, EnclosesTheSphereAndIsAFewStepsLarger, ()) {
  const Sphere s = *reference::testing::any_sphere();
  const Box box = Box::around(s);
  const float centre[] = {s.x, s.y, s.z};
  for (int axis = 0; axis < 3; ++axis) {
    RC_ASSERT(above(box.low[axis], centre[axis], s.radius) <= 0);
    RC_ASSERT(above(-box.high[axis], -centre[axis], s.radius) <= 0);
    float tight = box.low[axis];
    for (int step = 0; step < 3; ++step)
      tight = std::nextafter(tight, std::numeric_limits<float>::infinity());
    RC_ASSERT(above(tight, centre[axis], s.radius) > 0);
  }
}

TEST(Box, MeetsWhatItTouchesOnEveryAxis) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      Box other = box;
      other.low[axis] += side, other.high[axis] += side;
      EXPECT_TRUE(box.meets(other) && other.meets(box)) << axis;
      other.low[axis] += side / 8, other.high[axis] += side / 8;
      EXPECT_FALSE(box.meets(other) || other.meets(box)) << axis;
    }
}

}  // namespace
}  // namespace catena
