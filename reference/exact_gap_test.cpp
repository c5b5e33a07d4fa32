#include "catena/reference/exact_gap.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <limits>

#include "catena/reference/testing/nasty.h"

namespace catena::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;

constexpr float greatest_float = std::numeric_limits<float>::max();
constexpr float least_float = std::numeric_limits<float>::denorm_min();

/// q and t as rationals: another way from floats to exact numbers than that of exact_gap.cpp.
struct RationalSquares {
  Rational q, t;
  RationalSquares(const Sphere& a, const Sphere& b) {
    const Rational dx = Rational(a.x) - Rational(b.x), dy = Rational(a.y) - Rational(b.y),
                   dz = Rational(a.z) - Rational(b.z), s = Rational(a.radius) + Rational(b.radius);
    q = dx * dx + dy * dy + dz * dz;
    t = s * s;
  }
  int sign() const { return q < t ? -1 : q > t ? 1 : 0; }
};

/// True when no double is nearer to |q - t| / t than m.
bool is_nearest(double m, const RationalSquares& s) {
  const Rational exact = abs(s.q - s.t) / s.t;
  const auto error = [&](double v) -> Rational { return abs(Rational(v) - exact); };
  const double above = std::nextafter(m, std::numeric_limits<double>::infinity()),
               below = std::nextafter(m, 0.0);
  return error(m) <= error(above) && error(m) <= error(below);
}

void check(const Sphere& a, const Sphere& b) {
  const RationalSquares exact(a, b);
  RC_ASSERT(gap_sign(a, b) == exact.sign());
  RC_ASSERT(gap_sign_by_integers(a, b) == exact.sign());
  RC_ASSERT(gap_sign(b, a) == exact.sign());
  if (exact.t != 0) RC_ASSERT(is_nearest(margin(a, b), exact));
}

TEST(ExactGap, TouchingOnALattice) {
  EXPECT_EQ(gap_sign({0, 0, 0, 1}, {2, 0, 0, 1}), 0);
  EXPECT_EQ(gap_sign({0, 0, 0, 2}, {3, 4, 0, 3}), 0);
  EXPECT_EQ(gap_sign({-1, -2, -2, 1}, {0, 0, 0, 2}), 0);
  EXPECT_TRUE(overlap({0, 0, 0, 1}, {2, 0, 0, 1}));
  EXPECT_EQ(margin({0, 0, 0, 1}, {2, 0, 0, 1}), 0);
}

TEST(ExactGap, OneStepAroundTouching) {
  const float out = testing::nudged(2, 1), in = testing::nudged(2, -1);
  EXPECT_EQ(gap_sign({0, 0, 0, 1}, {out, 0, 0, 1}), 1);
  EXPECT_EQ(gap_sign({0, 0, 0, 1}, {in, 0, 0, 1}), -1);
  // A step of the smallest number there is, far below an ulp of the sum of squares, even in binary64.
  EXPECT_EQ(gap_sign({0, 0, 0, 1}, {2, least_float, 0, 1}), 1);
  EXPECT_EQ(gap_sign({0, 0, 0, 1}, {2, 0, 0, 1 + 0x1p-23f}), -1);
  EXPECT_EQ(gap_sign({0, 0, 0, 1}, {2, 0, 0, testing::nudged(1, -1)}), 1);
  EXPECT_EQ(gap_sign({least_float, 0, 0, 1}, {2, 0, 0, 1}), -1);
  EXPECT_EQ(margin({0, 0, 0, 1}, {2, least_float, 0, 1}), 0x1p-300);
}

TEST(ExactGap, EndsOfTheRange) {
  EXPECT_EQ(gap_sign({0, 0, 0, least_float}, {2 * least_float, 0, 0, least_float}), 0);
  EXPECT_EQ(gap_sign({0, 0, 0, least_float}, {2 * least_float, least_float, 0, least_float}), 1);
  EXPECT_EQ(gap_sign({-greatest_float, 0, 0, greatest_float}, {greatest_float, 0, 0, greatest_float}), 0);
  EXPECT_EQ(
      gap_sign({-greatest_float, 0, 0, greatest_float}, {greatest_float, least_float, 0, greatest_float}), 1);
  EXPECT_EQ(gap_sign({-greatest_float, -greatest_float, -greatest_float, greatest_float},
                     {greatest_float, greatest_float, greatest_float, greatest_float}),
            1);
  EXPECT_EQ(margin({-greatest_float, -greatest_float, -greatest_float, greatest_float},
                   {greatest_float, greatest_float, greatest_float, greatest_float}),
            2);
  EXPECT_EQ(margin({-greatest_float, 0, 0, least_float}, {greatest_float, 0, 0, 0}),
            std::ldexp(double{greatest_float}, 150) * std::ldexp(double{greatest_float}, 150));
}

/// Half way between two numbers, but for 2^-200: (1 + 2^-54 + 2^-200 - 1/4) / (1/4).
TEST(ExactGap, RoundsByAllDigits) {
  EXPECT_EQ(margin({0, 0, 0, 0.125f}, {1, 0x1p-27f, 0, 0.125f}), 15) << "a tie goes to the even one";
  EXPECT_EQ(margin({0, 0, 0, 0.25f}, {1, 0x1p-27f, 0, 0.25f}), 3);
  EXPECT_EQ(margin({0, 0, 0, 0.25f}, {1, 0x1p-27f, 0x1p-100f, 0.25f}), std::nextafter(3, 4));
}

TEST(ExactGap, Points) {
  EXPECT_EQ(gap_sign({1, 2, 3, 0}, {1, 2, 3, 0}), 0);
  EXPECT_EQ(gap_sign({0, 0, 0, 0}, {least_float, 0, 0, 0}), 1);
  EXPECT_EQ(margin({1, 2, 3, 0}, {1, 2, 3, 0}), 0);
  EXPECT_EQ(margin({0, 0, 0, 0}, {least_float, 0, 0, 0}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(margin({0, 0, 0, 1}, {0, 0, 0, 1}), 1);
}

RC_GTEST_PROP(ExactGap, AgreesWithRationalsOnAnyNumbers, ()) {
  check(*testing::any_sphere(), *testing::any_sphere());
}

RC_GTEST_PROP(ExactGap, AgreesWithRationalsNearTies, ()) {
  const int exponent = *rc::gen::inRange(-149, 121);
  check(*testing::lattice_sphere(exponent), *testing::lattice_sphere(exponent));
}

RC_GTEST_PROP(ExactGap, AgreesWithRationalsWhereRadiiMeetTheDistance, ()) {
  const auto [a, b] = *testing::nearly_touching_spheres();
  check(a, b);
}

}  // namespace
}  // namespace catena::reference
