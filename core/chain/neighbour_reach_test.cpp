#include "catena/core/chain/neighbour_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/properties/generators/family.h"

namespace catena {
namespace {

constexpr std::uint32_t any = NeighbourReach::any;

bool on_one_strand(const Chain& chain, std::uint32_t i, std::uint32_t j) {
  const std::vector<std::uint32_t>& first = chain.strands().first;
  const auto after = [&](std::uint32_t k) { return std::ranges::upper_bound(first, k) - first.begin(); };
  return after(i) == after(j);
}

/// What the numbers say is what the rule says, of every two spheres.
void expect_true(const Chain& chain, const std::string& of) {
  const NeighbourReach reach = chain.view().reach;
  for (std::uint32_t j = 0; j < chain.size(); ++j)
    for (std::uint32_t i = 0; i < j; ++i) {
      if (reach.none(i, j)) {
        ASSERT_FALSE(chain.neighbours(i, j)) << of << ' ' << i << ' ' << j;
      }
      if (j - i <= reach.certain && on_one_strand(chain, i, j)) {
        ASSERT_TRUE(chain.neighbours(i, j)) << of << ' ' << i << ' ' << j;
      }
    }
}

/// So many spheres along a line or circle, at even steps.
std::vector<Sphere> tube(std::uint32_t n, float radius, bool closed) {
  std::vector<Sphere> spheres;
  const double turn = 2 * std::numbers::pi / n;
  for (std::uint32_t k = 0; k < n; ++k)
    spheres.push_back(closed ? Sphere{static_cast<float>(std::cos(turn * k) / turn),
                                      static_cast<float>(std::sin(turn * k) / turn), 0, radius}
                             : Sphere{static_cast<float>(k), 0, 0, radius});
  return spheres;
}

TEST(NeighbourReach, SaysOfNoPairWhatTheRuleDoesNot) {
  std::uint64_t seed = 0;
  int certain = 0, bounded = 0, around = 0;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (const std::uint32_t size : {5u, 40u, 150u}) {
      properties::Dice dice(++seed);
      const Chain made = properties::generate(family, dice, size);
      const std::vector<Sphere> spheres(made.spheres().begin(), made.spheres().end());
      for (const double factor : {0.3, 1.6, 12.0, 1e30}) {
        Exclusion exclusion = Exclusion::arc(factor);
        if (seed % 3 == 0) exclusion.extra_pairs = made.exclusion().extra_pairs;
        const Chain chain(spheres, made.strands(), exclusion);
        expect_true(chain, family.name);
        const NeighbourReach reach = chain.view().reach;
        certain += reach.certain > 0 && reach.certain < size;
        bounded += reach.furthest + 1 < chain.size();
        around += reach.around < any;
      }
      expect_true(made, family.name);
      expect_true(
          Chain(spheres, made.strands(), Exclusion::index(static_cast<std::uint32_t>(dice.between(1, 12)))),
          family.name);
    }
  EXPECT_GT(certain, 5);
  EXPECT_GT(bounded, 20);
  EXPECT_GT(around, 20);
}

/// An arc window is told to within two strides of eight spheres, at either end of a strand and around it.
TEST(NeighbourReach, IsNearlyAsFarAsTheRuleReaches) {
  constexpr std::uint32_t n = 1000, off = 16;
  for (const float radius : {20.f, 50.5f, 120.f})
    for (const bool closed : {false, true}) {
      const auto real =
          static_cast<std::uint32_t>(2 * radius - 0.5f);  // the most steps nearer than twice the radius
      const Chain chain(tube(n, radius, closed), closed ? Strands::one_closed(n) : Strands{},
                        Exclusion::arc(1));
      expect_true(chain, closed ? "circle" : "line");
      const NeighbourReach reach = chain.view().reach;
      EXPECT_LE(reach.certain, real + 1) << radius;
      EXPECT_GE(reach.certain + off, real) << radius;
      EXPECT_GE(reach.furthest + 1, real) << radius;
      EXPECT_LE(reach.furthest, real + off) << radius;
      if (!closed) {
        EXPECT_EQ(reach.around, any);
      } else {
        EXPECT_LE(reach.around, n - real) << radius;
        EXPECT_GE(reach.around + 2, n - 2 * real) << radius << ", which either end alone may be near";
      }
    }
}

/// Small steps, and here and there one that is nearly as long as the window, or longer.
TEST(NeighbourReach, IsTrueWhereStepsAreUnlike) {
  int certain = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    properties::Dice dice(seed);
    const double longest = 4.5 + 6 * dice.unit() * static_cast<double>(seed % 3);
    std::vector<Sphere> spheres;
    double at = 0;
    for (int k = 0; k < 90; ++k) {
      spheres.push_back({static_cast<float>(at), 0, 0, 5});
      at += dice.one_in(30) ? longest * dice.unit() : 0.25;
    }
    const Chain chain(std::move(spheres), seed % 2 == 0 ? Strands{} : Strands::one_closed(90),
                      Exclusion::arc(1));
    certain += chain.view().reach.certain > 0;
    expect_true(chain, std::to_string(seed));
  }
  EXPECT_GT(certain, 100);
}

TEST(NeighbourReach, OfAnIndexWindowIsTheWindow) {
  const auto reach = [](Strands strands, Exclusion exclusion) {
    return Chain(tube(30, 1, false), std::move(strands), std::move(exclusion)).view().reach;
  };
  const NeighbourReach open = reach({}, Exclusion::index(4));
  EXPECT_EQ(open.certain, 4u);
  EXPECT_EQ(open.furthest, 4u);
  EXPECT_EQ(open.around, any);
  EXPECT_EQ(reach({{0, 10, 30}, {1, 1}}, Exclusion::index(4)).around, 6u) << "of the shortest loop";
  EXPECT_EQ(reach({{0, 10, 30}, {0, 1}}, Exclusion::index(4)).around, 16u) << "of loops alone";
  EXPECT_EQ(reach({{0, 3, 30}, {1, 0}}, Exclusion::index(4)).around, 0u);
  Exclusion joined = Exclusion::index(4);
  joined.extra_pairs = {{2, 20}};
  EXPECT_EQ(reach({}, joined).certain, 4u);
  EXPECT_EQ(reach({}, joined).furthest, any) << "an extra pair may be of any two";
}

/// Radii that change take the reach of an arc window with them, also where only those of a moved chain do.
TEST(NeighbourReach, FollowsTheRadiiOfAMovedChain) {
  const Chain thin(tube(200, 2, false), {}, Exclusion::arc(1));
  const Chain thick = thin.moved(tube(200, 30, false));
  EXPECT_GT(thick.view().reach.furthest, thin.view().reach.furthest + 20);
  EXPECT_GT(thick.view().reach.certain, thin.view().reach.certain + 20);
  expect_true(thick, "thick");
  std::vector<Sphere> one_thin = tube(200, 30, false), one_thick = tube(200, 2, false);
  one_thin[100].radius = 2, one_thick[100].radius = 30;
  expect_true(thick.moved(one_thin), "one is thin");
  EXPECT_LT(thick.moved(one_thin).view().reach.certain, 5u);
  expect_true(thin.moved(one_thick), "one is thick");
  EXPECT_GT(thin.moved(one_thick).view().reach.furthest, 50u);
  const Chain back = thick.moved(tube(200, 30, false));
  EXPECT_EQ(back.view().reach.furthest, thick.view().reach.furthest) << "the same radii, the same reach";
}

TEST(NeighbourReach, IsOfChainsOfAnySize) {
  for (const std::uint32_t n : {0u, 1u, 2u, 7u, 8u, 9u, 16u, 17u})
    for (const bool closed : {false, true})
      for (const float radius : {0.f, 0.4f, 0.5f, 3.f, std::numeric_limits<float>::max()})
        for (const Exclusion& rule : {Exclusion::arc(1), Exclusion::arc(2.5), Exclusion::index(3)})
          expect_true(Chain(tube(n, radius, closed), closed ? Strands::one_closed(n) : Strands{}, rule),
                      std::to_string(n));
}

}  // namespace
}  // namespace catena
