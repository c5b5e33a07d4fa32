#include "catena/core/lone_spheres/lone_spheres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/chain/chain.h"
#include "catena/properties/generators/dice.h"

namespace catena {
namespace {

using properties::Dice;

std::vector<std::uint32_t> others_of(const Chain& chain, const Team& team = Team()) {
  const auto cells = LoneCells::of(chain.view().extent, chain.size());
  if (!cells) return {};
  LargeVector<std::uint32_t> others;
  LoneSpheres().leave_out(chain.view(), *cells, others, team);
  return {others.begin(), others.end()};
}

std::vector<Sphere> dust(Dice& dice, std::uint32_t n, float room, float radius) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i)
    spheres.push_back({room * dice.symmetric(), room * dice.symmetric(), room * dice.symmetric(), radius});
  return spheres;
}

/// Spheres that overlap another one, neighbours too, and are not among the others.
std::uint32_t missed(const Chain& chain) {
  const std::vector<std::uint32_t> others = others_of(chain);
  std::vector<bool> there(chain.size(), false);
  for (const std::uint32_t i : others) there[i] = true;
  std::uint32_t count = 0;
  const Sphere* const s = chain.view().spheres;
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      if (!(there[i] && there[j]) && Robust::overlap(s[i], s[j])) ++count;
  return count;
}

TEST(LoneSpheres, LeaveOutNothingThatTouches) {
  for (const float room : {3.0f, 12.0f, 40.0f, 1e4f, 3e7f})
    for (const float shift : {0.0f, 100.0f, -5e3f}) {
      Dice dice(static_cast<std::uint32_t>(room) + 1);
      std::vector<Sphere> spheres = dust(dice, 1200, room, 0.5f);
      // Some have another that just touches, in all directions, or nearly.
      for (std::uint32_t i = 0; i + 1 < spheres.size(); i += 3) {
        Sphere& next = spheres[i + 1] = spheres[i];
        float* const at[] = {&next.x, &next.y, &next.z};
        *at[dice.between(0, 2)] += dice.pick({1.0f, -1.0f, std::nextafter(1.0f, 0.0f), 0.6f});
        if (dice.one_in(2)) *at[dice.between(0, 2)] += dice.pick({0.3f, -0.7f});
      }
      for (Sphere& s : spheres) s.x += shift, s.y -= shift;
      EXPECT_EQ(missed(Chain(spheres)), 0u) << room << ", " << shift;
      for (Sphere& s : spheres) s.radius *= dice.unit();
      EXPECT_EQ(missed(Chain(spheres)), 0u) << room << ", " << shift << ", unlike radii";
      for (Sphere& s : spheres) s.radius = 0;
      for (std::uint32_t i = 0; i + 7 < spheres.size(); i += 5) spheres[i + 7] = spheres[i];
      EXPECT_EQ(missed(Chain(spheres)), 0u) << room << ", " << shift << ", points";
    }
}

/// Pairs that just touch, one on either side of a border of cells, or as near to it as numbers are.
TEST(LoneSpheres, LeaveOutNothingThatTouchesAcrossBorders) {
  for (const float far : {16.0f, 1000.0f, 60'000.0f, 5e5f, 1e6f, 3e6f, 1e7f}) {
    std::vector<Sphere> spheres{{far, 0, 0, 0.5f}};
    const auto cells = LoneCells::of(Chain(spheres).view().extent, 2000);
    ASSERT_TRUE(cells);
    Dice dice(5);
    while (spheres.size() < 2000) {
      const float border = std::floor(far * dice.unit() * cells->cells_per_unit) / cells->cells_per_unit;
      float x = border;
      for (int k = dice.between(0, 3); k > 0; --k) x = std::nextafter(x, dice.one_in(2) ? -far : far);
      const float y = far * dice.symmetric(), z = far * dice.symmetric();
      spheres.push_back({x, y, z, 0.5f});
      spheres.push_back({x + (dice.one_in(2) ? 1.0f : -1.0f), y, z, 0.5f});
      if (std::abs(spheres.back().x) > far) spheres.back().x = far;
    }
    EXPECT_EQ(missed(Chain(spheres)), 0u) << far;
  }
}

/// The last one, however many more than full vectors or full parts of the chain there are.
TEST(LoneSpheres, LeaveOutNeitherTheFirstNorTheLastThatTouch) {
  for (const std::uint32_t n : {2u, 3u, 15u, 16u, 17u, 18u, 31u, 33u, 8191u, 8193u, 8205u, 16390u}) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({3.0f * static_cast<float>(i), 0, 0, 0.5f});
    for (const std::uint32_t with : {0u, (n - 1) / 2}) {
      spheres[n - 1] = spheres[with], spheres[n - 1].y += 1;
      const std::vector<std::uint32_t> others = others_of(Chain(spheres));
      for (const std::uint32_t i : {with, n - 1})
        EXPECT_TRUE(std::ranges::binary_search(others, i)) << i << " of " << n;
    }
  }
}

/// Two on either side of where the last bit of the map is followed by the first.
TEST(LoneSpheres, LeaveOutNothingThatTouchesAcrossTheEndOfTheMap) {
  std::size_t across = 0;
  for (float x = 32767; x < 32769; x += 1.0f / 64) {
    const Chain chain({{x, 0, 0, 0.23f}, {x + 0.4375f, 0, 0, 0.23f}});
    ASSERT_TRUE(Robust::overlap(chain[0], chain[1]));
    const auto cells = LoneCells::of(chain.view().extent, chain.size());
    ASSERT_TRUE(cells);
    ASSERT_EQ(cells->bits, 1u << 15);
    const auto cell = [&](std::uint32_t i) { return std::floor(chain[i].x * cells->cells_per_unit); };
    across += cell(0) < 32768 && cell(1) >= 32768;
    EXPECT_EQ(others_of(chain), (std::vector<std::uint32_t>{0, 1})) << x;
  }
  EXPECT_GT(across, 10u);
}

TEST(LoneSpheres, LeaveOutMostPointsThatAreNowhereNear) {
  Dice dice(9);
  std::vector<Sphere> points = dust(dice, 4000, 100, 0);
  points[3999] = points[7];
  const std::vector<std::uint32_t> others = others_of(Chain(points));
  EXPECT_GE(others.size(), 2u);
  EXPECT_LT(others.size(), 2000u);
  EXPECT_TRUE(std::ranges::binary_search(others, 7u) && std::ranges::binary_search(others, 3999u));
}

TEST(LoneSpheres, LeaveOutMostOfWhatIsSparse) {
  Dice dice(1);
  const Chain sparse(dust(dice, 20'000, 200, 0.5f)), points(dust(dice, 20'000, 200, 0));
  EXPECT_LT(others_of(sparse).size(), sparse.size() / 2);
  EXPECT_LT(others_of(points).size(), points.size() / 5);
  LoneSpheres lone;
  EXPECT_TRUE(lone.pay(sparse.view(), *LoneCells::of(sparse.view().extent, sparse.size())));
  EXPECT_TRUE(lone.pay(points.view(), *LoneCells::of(points.view().extent, points.size())));
  const Team several(Parameters("test", {Team::threads_parameter()}, "threads=3"));
  EXPECT_EQ(others_of(sparse, several), others_of(sparse));
}

/// Wherever a chain's next sphere is near, or much is, or its own order tells what is near.
TEST(LoneSpheres, AreNotLookedForElsewhere) {
  Dice dice(2);
  const auto pay = [](const std::vector<Sphere>& spheres) {
    const Chain chain(spheres);
    return LoneSpheres().pay(chain.view(), *LoneCells::of(chain.view().extent, chain.size()));
  };
  EXPECT_FALSE(pay(dust(dice, 20'000, 20, 0.5f))) << "much is near";
  EXPECT_FALSE(pay(dust(dice, 2000, 100, 0.5f))) << "a few";
  std::vector<Sphere> line, steps;
  for (int i = 0; i < 20'000; ++i) {
    line.push_back({static_cast<float>(i), 0, 0, 0.5f});
    steps.push_back({5.0f * static_cast<float>(i), dice.unit(), dice.unit(), 0.5f});
  }
  // A smooth curve of spheres with gaps, whose parts lie among one another: blocks tell them apart.
  std::vector<Sphere> curve;
  const double n = 20'000, room = 0.6 * std::sqrt(n), turns = std::floor(std::sqrt(n) / 6);
  for (int i = 0; i < 20'000; ++i) {
    const double at = 2 * M_PI * i / n;
    curve.push_back({static_cast<float>(room * std::cos(turns * at)),
                     static_cast<float>(room * std::sin((turns + 1) * at)),
                     static_cast<float>(room * std::sin((turns + 7) * at + 0.3)), 0.075f});
  }
  EXPECT_FALSE(pay(curve));
  EXPECT_FALSE(pay(line));
  EXPECT_FALSE(pay(steps));
}

TEST(LoneSpheres, HaveNoCellsWhereThereIsNothingToTellApart) {
  EXPECT_FALSE(LoneCells::of(Chain(std::vector<Sphere>(10)).view().extent, 10)) << "points at the origin";
  EXPECT_FALSE(LoneCells::of(Chain({{0, 0, 0, 1e-44f}}).view().extent, 1));
  EXPECT_FALSE(LoneCells::of(Chain({{0, 0, 0, 3e38f}, {3e38f, 0, 0, 3e38f}}).view().extent, 2));
  for (const float scale : {1e-30f, 1.0f, 1e30f})
    EXPECT_EQ(missed(Chain({{0, 0, 0, scale}, {2 * scale, 0, 0, scale}, {9 * scale, 0, 0, scale}})), 0u);
}

}  // namespace
}  // namespace catena
