#include "catena/bench/pivot/rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace catena::bench {
namespace {

Vec3 random_vector(Random& random) { return {random.symmetric(), random.symmetric(), random.symmetric()}; }

/// Of a rotation that is uniformly distributed the fourth powers of the numbers add up to a half on average;
/// those from a whole cube lean to its corners, where they add up to a quarter.
TEST(Rotation, IsUniformlyDistributed) {
  Random random(5);
  constexpr int times = 20000;
  double fourth = 0;
  for (int k = 0; k < times; ++k) {
    const Rotation r = random_rotation(random);
    EXPECT_NEAR(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z, 1, 1e-12);
    for (const double q : {r.w, r.x, r.y, r.z}) fourth += q * q * q * q;
  }
  EXPECT_NEAR(fourth / times, 0.5, 0.01);
}

TEST(Rotation, AfterAnotherIsTheOneThenTheOther) {
  Random random(6);
  for (int k = 0; k < 100; ++k) {
    const Rotation a = random_rotation(random), b = random_rotation(random);
    const Vec3 v = random_vector(random);
    EXPECT_LT(length(a.after(b)(v) - a(b(v))), 1e-12);
    EXPECT_LT(length(a.inverse()(a(v)) - v), 1e-12);
  }
}

/// The least ball around two, whether they lie apart, meet, or one holds the other.
TEST(CentreBall, OfTwoIsTheLeastAroundBoth) {
  Random random(7);
  int within = 0;
  for (int k = 0; k < 1000; ++k) {
    const CentreBall a{random_vector(random), std::abs(random.symmetric())},
        b{k % 10 == 0 ? a.centre : random_vector(random), std::abs(random.symmetric())};
    const CentreBall both = join(a, b);
    const double distance = length(b.centre - a.centre);
    for (const CentreBall& one : {a, b})
      EXPECT_LE(length(one.centre - both.centre) + one.radius, both.radius + 1e-12);
    EXPECT_NEAR(both.radius, std::max({a.radius, b.radius, (distance + a.radius + b.radius) / 2}), 1e-12);
    within += distance + std::min(a.radius, b.radius) <= std::max(a.radius, b.radius);
  }
  EXPECT_GT(within, 50);
}

}  // namespace
}  // namespace catena::bench
