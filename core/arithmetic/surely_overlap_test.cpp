#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "catena/core/arithmetic/exact_sign.h"
#include "catena/core/arithmetic/robust.h"

namespace catena {
namespace {

/// Spheres that nearly touch, a few steps between floats to either side, at every magnitude: how many are
/// said to overlap and do not, and how many are said to at all.
template <class Test>
std::pair<std::size_t, std::size_t> said(const Test& test) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::size_t wrong = 0, all = 0;
  for (int exponent = -140; exponent <= 120; ++exponent)
    for (int k = 0; k < 60; ++k) {
      const float reach = std::ldexp(1.0f, exponent), share = 0.5f + 0.5f * unit(random);
      float d[3] = {unit(random), unit(random), unit(random)};
      if (k % 4 == 0) d[1] = d[2] = 0;
      const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      const Sphere a{0, 0, 0, share * reach};
      Sphere b{d[0] / length * reach, d[1] / length * reach, d[2] / length * reach, (1 - share) * reach};
      for (int step = -8; step <= 8; ++step) {
        const bool overlaps = ExactSign::of_gap(a, b) <= 0, claimed = test(a, b);
        wrong += claimed && !overlaps;
        all += claimed;
        b.x = std::nextafter(b.x, std::copysign(std::numeric_limits<float>::max(), b.x));
      }
      all += test(a, {b.x / 2, b.y / 2, b.z / 2, b.radius});
    }
  return {wrong, all};
}

TEST(SurelyOverlap, IsNeverSaidOfSpheresThatDoNot) {
  const auto [wrong, all] =
      said([](const Sphere& a, const Sphere& b) { return Robust::surely_overlap(a, b); });
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(all, 1000u);
  EXPECT_FALSE(Robust::surely_overlap({3e38f, 0, 0, 3e38f}, {-3e38f, 0, 0, 3e38f})) << "out of range";
}

TEST(SurelyOverlap, WithoutItsSlackTheTestSeesIt) {
  const auto bare = [](const Sphere& a, const Sphere& b) {
    const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.radius + b.radius;
    return dx * dx + dy * dy + dz * dz <= reach * reach;
  };
  EXPECT_GT(said(bare).first, 0u);
}

}  // namespace
}  // namespace catena
