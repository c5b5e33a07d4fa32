#include "catena/core/chain/joints.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/core/error.h"

namespace catena {
namespace {

using Pairs = std::vector<Pair>;

// A stem 0-1-2-3-4 along x and a branch 5-6-7 that grows from 2 along y, one apart.
const std::vector<Sphere> tree{{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 1}, {3, 0, 0, 1},
                               {4, 0, 0, 1}, {2, 1, 0, 1}, {2, 2, 0, 1}, {2, 3, 0, 1}};
const Strands tree_strands{{0, 5, 8}, {0, 0}};
const Pairs tree_joint{{2, 5}};

TEST(Joints, AreTheOnlyPairsOfWindowOne) {
  EXPECT_EQ(pairs_across_joints(tree, tree_strands, tree_joint, Exclusion::index(1)), tree_joint);
  EXPECT_TRUE(pairs_across_joints(tree, tree_strands, {}, Exclusion::index(9)).empty());
}

/// Of so many branches at one sphere that each may not look at all others: that would take seconds.
TEST(Joints, AreFoundAtASphereOfManyBranches) {
  constexpr std::uint32_t branches = 20'000;
  std::vector<Sphere> star{{0, 0, 0, 0.01f}};
  Strands strands{{0, 1}, {0}};
  Pairs joints;
  for (std::uint32_t k = 1; k <= branches; ++k) {
    star.push_back({static_cast<float>(k), 0, 0, 0.01f});
    strands.first.push_back(k + 1), strands.closed.push_back(0);
    joints.push_back({0, k});
  }
  EXPECT_EQ(pairs_across_joints(star, strands, joints, Exclusion::index(1)), joints);
  EXPECT_EQ(pairs_across_joints(star, strands, joints, Exclusion::arc(75)), (Pairs{{0, 1}}));
}

TEST(Joints, AreCrossedByLongerWindows) {
  EXPECT_EQ(pairs_across_joints(tree, tree_strands, tree_joint, Exclusion::index(2)),
            (Pairs{{1, 5}, {2, 5}, {2, 6}, {3, 5}}));
  EXPECT_EQ(pairs_across_joints(tree, tree_strands, tree_joint, Exclusion::index(~0u)).size(), 15u);
}

TEST(Joints, AreCrossedByArcWindowsStrictly) {
  EXPECT_TRUE(
      pairs_across_joints(tree, tree_strands, tree_joint, Exclusion::arc(0.5)).empty());  // 1 < 1 is false
  EXPECT_EQ(pairs_across_joints(tree, tree_strands, tree_joint, Exclusion::arc(0.51)), tree_joint);
  EXPECT_EQ(pairs_across_joints(tree, tree_strands, tree_joint, Exclusion::arc(1.01)).size(), 4u);
}

TEST(Joints, ReachFarFromAHugeSphere) {
  auto soma = tree;
  soma[0].radius = 100;
  EXPECT_EQ(pairs_across_joints(soma, tree_strands, tree_joint, Exclusion::arc(0.4)),
            (Pairs{{0, 5}, {0, 6}, {0, 7}}));
}

/// The joint is all but as far from the great sphere, which alone may find the pair, as that reaches.
TEST(Joints, AreCrossedAtTheLimitOfTheReach) {
  const std::vector<Sphere> far{{0, 0, 0, 1000.25f}, {1999.75f, 0, 0, 0}, {1999.75f, 0, 0, 1000}};
  const Strands strands{{0, 2, 3}, {0, 0}};
  EXPECT_EQ(pairs_across_joints(far, strands, Pairs{{1, 2}}, Exclusion::arc(1)), (Pairs{{0, 2}, {1, 2}}));
}

/// From the joint the steps along the second strand add up to more than the limit, and from its other end
/// to 1.
TEST(Joints, AreCrossedWhereTheSameWayIsRoundedDifferently) {
  const float tiny = 0x1p-53f;
  const std::vector<Sphere> spheres{{1, 0, tiny, 0.5f}, {1, 0, tiny, 0}, {1, tiny, tiny, 0},
                                    {1, tiny, 0, 0},    {1, 0, 0, 0},    {0, 0, 0, 0.5f}};
  EXPECT_EQ(pairs_across_joints(spheres, {{0, 1, 6}, {0, 0}}, Pairs{{0, 1}}, Exclusion::arc(1 + 0x1p-52)),
            (Pairs{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}));
}

TEST(Joints, GoAroundClosedStrands) {
  const Strands ring{{0, 5, 8}, {1, 0}};
  const auto pairs = pairs_across_joints(tree, ring, Pairs{{0, 5}}, Exclusion::index(2));
  EXPECT_EQ(pairs, (Pairs{{0, 5}, {0, 6}, {1, 5}, {4, 5}}));
}

// 0-1-2-3-4-5 whose end is tied back to 1: a loop of five on a stem.
TEST(Joints, TieALoopToItsOwnStrand) {
  const std::vector<Sphere> loop{{0, 0, 0, 1}, {1, 0, 0, 1},    {2, 0, 0, 1},
                                 {2, 1, 0, 1}, {1.5f, 2, 0, 1}, {1, 1, 0, 1}};
  const Strands one{{0, 6}, {0}};
  EXPECT_EQ(pairs_across_joints(loop, one, Pairs{{1, 5}}, Exclusion::index(1)), (Pairs{{1, 5}}));
  EXPECT_EQ(pairs_across_joints(loop, one, Pairs{{1, 5}}, Exclusion::index(2)),
            (Pairs{{0, 5}, {1, 4}, {1, 5}, {2, 5}}));
}

TEST(Joints, AreToldOnceWhereALongWayIsFoundFirst) {
  // From 0 over joints: to 2 at once, by 10, or by 1 and 1.
  const std::vector<Sphere> spheres{{0, 0, 0, 9}, {0, 1, 0, 1}, {0, 1, 1, 1}, {0, 1, 2, 1}};
  const Strands each{{0, 1, 2, 3, 4}, {0, 0, 0, 0}};
  const Pairs all{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  EXPECT_EQ(pairs_across_joints(spheres, each, Pairs{{0, 3}, {0, 2}, {0, 1}, {1, 2}, {2, 3}, {1, 3}},
                                Exclusion::arc(3)),
            all);
  const std::vector<Sphere> detour{{0, 0, 0, 9}, {5, 5, 0, 1}, {0, 6, 0, 1}, {1, 0, 0, 1}, {5, 0, 0, 1}};
  const auto pairs = pairs_across_joints(detour, {{0, 1, 2, 3, 4, 5}, {0, 0, 0, 0, 0}},
                                         Pairs{{0, 2}, {2, 1}, {0, 3}, {3, 4}, {4, 1}}, Exclusion::arc(9));
  EXPECT_EQ(std::ranges::adjacent_find(pairs), pairs.end());
}

TEST(Joints, TakeNoNoticeOfClosedStrandsOfFewSpheres) {
  // A joint between the first and the last; closed strands of none, one and two spheres do not matter.
  const std::vector<Sphere> spheres(tree.begin(), tree.begin() + 5);
  for (const std::uint8_t closed : {std::uint8_t{0}, std::uint8_t{1}})
    EXPECT_EQ(pairs_across_joints(spheres, {{0, 0, 1, 1, 3, 5}, {closed, closed, closed, closed, 0}},
                                  Pairs{{0, 4}}, Exclusion::index(2)),
              (Pairs{{0, 3}, {0, 4}}));
}

TEST(Joints, MustNameTwoSpheres) {
  EXPECT_THROW(pairs_across_joints(tree, tree_strands, Pairs{{2, 8}}, Exclusion::index(1)), InputError);
  EXPECT_THROW(pairs_across_joints(tree, tree_strands, Pairs{{2, 2}}, Exclusion::index(1)), InputError);
}

struct Tangle {
  std::vector<Sphere> spheres;
  Strands strands{{0}, {}};
  Pairs joints;
};

// Small whole numbers, so that sums of lengths along the axis are exact and the two ways to sum agree.
Tangle any_tangle() {
  Tangle t;
  for (auto left = *rc::gen::inRange(2, 5); left > 0; --left) {
    for (auto more = *rc::gen::inRange(1, 6); more > 0; --more)
      t.spheres.push_back({float(*rc::gen::inRange(-9, 9)), 0, 0, float(*rc::gen::inRange(0, 9))});
    t.strands.first.push_back(static_cast<std::uint32_t>(t.spheres.size()));
    t.strands.closed.push_back(*rc::gen::arbitrary<bool>());
  }
  const auto n = static_cast<std::uint32_t>(t.spheres.size());
  for (auto joints = *rc::gen::inRange(0, 5); joints > 0; --joints) {
    const auto i = *rc::gen::inRange<std::uint32_t>(0, n);
    t.joints.push_back({i, (i + *rc::gen::inRange<std::uint32_t>(1, n)) % n});
  }
  return t;
}

using Ways = std::vector<std::vector<double>>;

// Floyd and Warshall: every shortest way, by a method that has nothing in common with the one under test.
Ways all_ways(const Tangle& t, const Pairs& joints, bool by_index) {
  const auto n = static_cast<std::uint32_t>(t.spheres.size());
  Ways way(n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
  const auto edge = [&](std::uint32_t i, std::uint32_t j) {
    way[i][j] = way[j][i] = by_index ? 1 : std::abs(double{t.spheres[i].x} - t.spheres[j].x);
  };
  for (std::uint32_t s = 0; s < t.strands.closed.size(); ++s) {
    const auto first = t.strands.first[s], last = t.strands.first[s + 1];
    for (auto i = first; i + 1 < last; ++i) edge(i, i + 1);
    if (t.strands.closed[s]) edge(first, last - 1);
  }
  for (const Pair& joint : joints) edge(joint.i, joint.j);
  for (std::uint32_t k = 0; k < n; ++k)
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < n; ++j) way[i][j] = std::min(way[i][j], way[i][k] + way[k][j]);
  return way;
}

Pairs by_all_ways(const Tangle& t, const Exclusion& rule) {
  const auto n = static_cast<std::uint32_t>(t.spheres.size());
  const bool by_index = rule.rule == Exclusion::Rule::index_window;
  const Ways way = all_ways(t, t.joints, by_index), along = all_ways(t, {}, by_index);
  Pairs pairs;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j)
      if (way[i][j] < along[i][j] &&
          (by_index ? way[i][j] <= rule.window
                    : way[i][j] < rule.factor * (double{t.spheres[i].radius} + t.spheres[j].radius)))
        pairs.push_back({i, j});
  return pairs;
}

/// A way over a joint need be shorter than the strand's by one step of many, or by a thousandth, only.
TEST(Joints, AreCrossedWhereTheySaveLittle) {
  Tangle t;
  for (std::uint32_t i = 0; i < 12; ++i) t.spheres.push_back({static_cast<float>(i), 0, 0, 6});
  t.strands = {{0, 12}, {0}};
  t.joints = {{0, 2}};
  for (std::uint32_t window = 2; window <= 12; ++window) {
    const Exclusion rule = Exclusion::index(window);
    const Pairs pairs = pairs_across_joints(t.spheres, t.strands, t.joints, rule);
    EXPECT_EQ(pairs, by_all_ways(t, rule)) << window;
    EXPECT_TRUE(std::ranges::binary_search(pairs, Pair{0, std::min(window + 1, 11u)})) << window;
  }
  // To and fro, and then ten further: the joint saves the first two steps.
  for (const float step : {1 / 128.f, 1 / 16.f, 1 / 4.f, 1 / 2.f}) {
    t = {{{0, 0, 0, 6}, {step, 0, 0, 0}, {0, 0, 0, 0}, {10, 0, 0, 6}}, {{0, 4}, {0}}, {{0, 2}}};
    const Exclusion rule = Exclusion::arc(1);
    const Pairs pairs = pairs_across_joints(t.spheres, t.strands, t.joints, rule);
    EXPECT_EQ(pairs, by_all_ways(t, rule)) << step;
    EXPECT_TRUE(std::ranges::binary_search(pairs, Pair{0, 3})) << step;
  }
}

RC_GTEST_PROP(Joints, GiveThePairsOfAllShortestWays, ()) {
  const Tangle t = any_tangle();
  const Exclusion rule = *rc::gen::arbitrary<bool>()
                             ? Exclusion::index(*rc::gen::inRange<std::uint32_t>(1, 8))
                             : Exclusion::arc(*rc::gen::inRange(1, 12) / 4.0);
  RC_ASSERT(pairs_across_joints(t.spheres, t.strands, t.joints, rule) == by_all_ways(t, rule));
}

}  // namespace
}  // namespace catena
