#include "catena/core/arithmetic/exact_sign.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/reference/exact_gap.h"
#include "catena/reference/testing/nasty.h"

namespace catena {
namespace {

using reference::gap_sign;
namespace testing = reference::testing;

TEST(ExactSign, IsMinusOneZeroOrOne) {
  EXPECT_EQ(ExactSign::of_gap({0, 0, 0, 2}, {3, 4, 0, 2}), 1);
  EXPECT_EQ(ExactSign::of_gap({0, 0, 0, 2}, {3, 4, 0, 3}), 0);
  EXPECT_EQ(ExactSign::of_gap({0, 0, 0, 2}, {3, 4, 0, 4}), -1);
}

// The strategies ask it only where their filter is in doubt, which is rare; here it meets every kind of
// sphere.
RC_GTEST_PROP(ExactSign, IsTheReferencesOnAnyNumbers, ()) {
  const auto a = *testing::any_sphere(), b = *testing::any_sphere();
  RC_ASSERT(ExactSign::of_gap(a, b) == gap_sign(a, b));
}

RC_GTEST_PROP(ExactSign, IsTheReferencesNearTies, ()) {
  const int exponent = *rc::gen::inRange(-149, 121);
  const auto a = *testing::lattice_sphere(exponent), b = *testing::lattice_sphere(exponent);
  RC_ASSERT(ExactSign::of_gap(a, b) == gap_sign(a, b));
}

RC_GTEST_PROP(ExactSign, IsTheReferencesWhereRadiiMeetTheDistance, ()) {
  auto a = *testing::any_sphere(), b = *testing::any_sphere();
  const double distance = std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
  RC_PRE(distance < std::numeric_limits<float>::max());
  a.radius = static_cast<float>(distance * *rc::gen::inRange(0, 9) / 8);
  b.radius = std::fabs(
      testing::nudged(static_cast<float>(std::max(0.0, distance - a.radius)), *rc::gen::inRange(-1, 2)));
  RC_ASSERT(ExactSign::of_gap(a, b) == gap_sign(a, b));
}

}  // namespace
}  // namespace catena
