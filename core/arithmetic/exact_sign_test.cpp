#include "catena/core/arithmetic/exact_sign.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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
  const auto [a, b] = *testing::nearly_touching_spheres();
  RC_ASSERT(ExactSign::of_gap(a, b) == gap_sign(a, b));
}

}  // namespace
}  // namespace catena
