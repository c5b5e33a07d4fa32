#include "catena/core/frames/near_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "catena/core/arithmetic/exact_sign.h"

namespace catena {
namespace {

/// Pairs 2 k, 2 k + 1 of unlike radii that are about as far apart as their skins let them touch or part, at
/// magnitudes from subnormal to near the greatest.
std::vector<Sphere> around_the_edges(float skin) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Sphere> spheres;
  for (int k = 0; k < 3000; ++k) {
    const float a = skin * std::ldexp(unit(random), static_cast<int>(random() % 12) - 2),
                b = skin * std::ldexp(unit(random), static_cast<int>(random() % 12) - 2);
    float distance = a + b + skin * (k % 2 ? 2.0f : -2.0f);
    for (int step = static_cast<int>(random() % 41) - 20; step != 0; step += step < 0 ? 1 : -1)
      distance = std::nextafter(distance, step < 0 ? 0.0f : INFINITY);
    float d[3] = {unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f};
    if (k % 3 == 0) d[1] = d[2] = 0;
    const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / std::fabs(distance);
    const Sphere at{k % 5 ? 0 : skin * unit(random), 0, 0, a};
    spheres.push_back(at);
    spheres.push_back({at.x + d[0] / length, at.y + d[1] / length, at.z + d[2] / length, b});
  }
  return spheres;
}

TEST(PartPairs, LeavesOutNoPairWhoseSkinsAreNotSettledExactly) {
  for (const float skin : {1e-36f, 1e-20f, 0.001f, 1.0f, 3e12f, 1e34f}) {
    const std::vector<Sphere> spheres = around_the_edges(skin);
    std::vector<Pair> pairs;
    for (std::uint32_t k = 0; k < spheres.size(); k += 2) pairs.push_back({k, k + 1});
    const std::size_t size = pairs.size() - 3;  // not a multiple of eight
    pairs.resize(size + 7, pairs.back());
    std::vector<std::uint8_t> collide((size + 7) / 8, 0);
    LargeVector<std::uint32_t> changed;
    OpenPairs open;
    part_pairs(spheres, std::span(pairs).first(size), skin, collide, changed, open);
    std::vector<bool> is_open(size, false), has_changed(size, false);
    for (std::size_t m = 0; m < open.size; ++m) {
      is_open[open.state[m] / 2] = true;
      EXPECT_EQ(open.pairs[m], pairs[open.state[m] / 2]);
      EXPECT_EQ(open.state[m] % 2, collide[open.state[m] / 16] >> (open.state[m] / 2 % 8) & 1u);
    }
    for (const std::uint32_t k : changed) has_changed[k] = true;
    std::size_t settled = 0, separate = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const Sphere &a = spheres[pairs[k].i], &b = spheres[pairs[k].j];
      const bool overlap = ExactSign::of_gap(a, b) <= 0;
      ASSERT_EQ(collide[k / 8] >> (k % 8) & 1, overlap) << k << " at " << skin;
      ASSERT_EQ(has_changed[k], overlap);
      if (is_open[k]) continue;
      const Sphere thin_a = thinner(a, skin), thin_b = thinner(b, skin);
      if (overlap) {
        // A radius may be negative; their sum, which is one rounding away, is what counts.
        const double reach = double{thin_a.radius} + thin_b.radius;
        ASSERT_GE(reach, 0) << k;
        const double dx = double{a.x} - b.x, dy = double{a.y} - b.y, dz = double{a.z} - b.z;
        ASSERT_LE(std::sqrt(dx * dx + dy * dy + dz * dz), reach * (1 + 0x1p-50)) << k << " at " << skin;
        ++settled;
      } else {
        ASSERT_GT(ExactSign::of_gap(thicker(a, skin), thicker(b, skin)), 0) << k << " at " << skin;
        ++separate;
      }
    }
    const bool in_range = skin > 1e-15f && skin < 1e15f;  // of squares in binary32; beyond, all are open
    EXPECT_EQ(settled > 0, in_range) << skin;
    EXPECT_EQ(separate > 0, in_range) << skin;
    EXPECT_GT(open.size, 0u) << skin;
  }
}

}  // namespace
}  // namespace catena
