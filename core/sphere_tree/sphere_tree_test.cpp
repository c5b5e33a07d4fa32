#include "catena/core/sphere_tree/sphere_tree.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/sphere_tree/test_search.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {
namespace {

float field(const SphereTree& tree, std::size_t level, std::uint32_t k, std::uint32_t f) {
  return tree.boxes_of(level, k / SphereTree::group)[f * SphereTree::group + k % SphereTree::group];
}

/// Exactly, as a sum of two binary32 numbers is with a third in binary64 but for its rounding, which is
/// monotone.
bool holds(const SphereTree& tree, std::uint32_t node, const Sphere& s) {
  const double at[3] = {s.x, s.y, s.z};
  for (std::uint32_t d = 0; d < 3; ++d)
    if (at[d] - field(tree, 0, node, d) < s.radius || field(tree, 0, node, 3 + d) - at[d] < s.radius)
      return false;
  return true;
}

std::vector<std::uint32_t> all_of(const Chain& chain) {
  std::vector<std::uint32_t> all(chain.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// It holds these spheres, which ascend.
void expect_sound(const Chain& chain, const SphereTree& tree, const std::string& what,
                  const std::vector<std::uint32_t>& spheres) {
  constexpr std::uint32_t group = SphereTree::group;
  ASSERT_EQ(tree.spheres, spheres.size()) << what;
  std::vector<std::uint32_t> all;
  for (std::uint32_t place = 0; place < tree.spheres; ++place) {
    const std::uint32_t i = tree.index[place];
    all.push_back(i);
    const float* const own = tree.fields_of(place / group) + place % group;
    EXPECT_EQ((Sphere{own[0], own[group], own[2 * group], own[3 * group]}), chain.spheres()[i]) << what;
    EXPECT_TRUE(holds(tree, place / group, chain.spheres()[i])) << what << ": sphere " << i;
  }
  for (std::uint32_t place = tree.spheres; place < tree.nodes() * group; ++place)
    EXPECT_TRUE(std::isnan(tree.fields_of(place / group)[place % group])) << what;
  std::ranges::sort(all);
  ASSERT_EQ(all, spheres) << what;
  for (std::size_t l = 0; l < tree.boxes.size(); ++l) {
    EXPECT_EQ(tree.count(l) <= group, l + 1 == tree.boxes.size()) << what << ": a single group is the top";
    for (std::uint32_t k = tree.count(l); k % group != 0; ++k)
      for (std::uint32_t d = 0; d < 3; ++d)
        EXPECT_GT(field(tree, l, k, d), field(tree, l, k, 3 + d)) << what << ": what fills a group up meets";
  }
  for (std::size_t l = 1; l < tree.boxes.size(); ++l)
    for (std::uint32_t k = 0; k < tree.count(l - 1); ++k)
      for (std::uint32_t d = 0; d < 3; ++d) {
        EXPECT_LE(field(tree, l, k / group, d), field(tree, l - 1, k, d)) << what;
        EXPECT_GE(field(tree, l, k / group, 3 + d), field(tree, l - 1, k, 3 + d)) << what;
      }
}

TEST(SphereTree, HoldsEachSphereOnceAndInItsBoxes) {
  std::uint64_t seed = 40;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (const std::uint32_t size : {20u, 257u, 3000u}) {
      properties::Dice dice(++seed);
      const Chain chain = properties::generate(family, dice, size);
      SphereTree tree;
      build_sphere_tree(chain.view(), tree, {}, Team());
      expect_sound(chain, tree, family.name, all_of(chain));
    }
}

/// An order is kept of the very spheres that were sorted, wherever they are now: not of as many others.
TEST(SphereTree, KeepsAnOrderOfTheSameSpheresAlone) {
  using Indices = std::vector<std::uint32_t>;
  properties::Dice dice(12);
  const auto dust = [&](std::uint32_t count) {
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 0; k < count; ++k)
      spheres.push_back({20 * dice.symmetric(), 20 * dice.symmetric(), 20 * dice.symmetric(), 0.7f});
    return spheres;
  };
  std::vector<Sphere> spheres = dust(4501);  // three levels of nodes, and two of half of them
  Indices odd, even, other_middle, other_end;
  for (std::uint32_t i = 0; i < 4500; ++i) (i % 2 == 0 ? even : odd).push_back(i);
  other_middle = other_end = odd;
  ++other_middle[1000], ++other_end.back();
  const Chain few(dust(2250));
  SphereTree tree;
  const auto frames_kept = [&](const Chain& chain, const Indices& only) {
    build_sphere_tree(chain.view(), tree, only, Team(), SpaceSort::where_needed);
    expect_sound(chain, tree, fmt::format("{} of {}", only.size(), chain.size()),
                 only.empty() ? all_of(chain) : only);
    return tree.kept.frames();
  };
  EXPECT_EQ(frames_kept(Chain(spheres), even), 0u) << "nothing was sorted yet";
  for (const Indices& only : {odd, other_middle, odd, other_end, Indices(), even, Indices()}) {
    EXPECT_EQ(frames_kept(Chain(spheres), only), 0u);
    for (Sphere& s : spheres) s.x += 0.05f * dice.symmetric(), s.z += 0.05f * dice.symmetric();
    EXPECT_EQ(frames_kept(Chain(spheres), only), 1u) << only.size();
  }
  EXPECT_EQ(frames_kept(Chain(spheres), even), 0u);
  EXPECT_EQ(frames_kept(few, {}), 0u) << "as many, but all of another chain";
  EXPECT_EQ(frames_kept(few, {}), 1u);
  EXPECT_EQ(frames_kept(Chain(spheres), even), 0u);
  // A build is the same whatever was built before.
  SphereTree fresh;
  for (Sphere& s : spheres) s.x += 0.05f * dice.symmetric();
  const Chain moved(spheres);
  build_sphere_tree(moved.view(), tree, even, Team());
  build_sphere_tree(moved.view(), fresh, even, Team());
  EXPECT_TRUE(std::ranges::equal(tree.index, fresh.index));
  // Nor is it kept where a few went elsewhere, be they the last.
  for (const std::uint32_t first : {0u, tree.spheres - 40}) {
    tree = {};
    build_sphere_tree(moved.view(), tree, even, Team());
    std::vector<Sphere> scattered = spheres;
    for (std::uint32_t k = first; k < first + 40; ++k)
      scattered[tree.index[k]] = spheres[tree.index[(k + 100 * (k - first + 1)) % tree.spheres]];
    EXPECT_EQ(frames_kept(Chain(scattered), even), 0u) << first;
  }
}

TEST(SphereTree, IsTheSameForAnyTeam) {
  properties::Dice dice(8);
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < 60'000; ++k) {
    const float wide = dice.one_in(3) ? 0.01f : 100.0f;
    spheres.push_back(
        {wide * dice.symmetric(), wide * dice.symmetric(), wide * dice.symmetric(), 0.01f * wide});
  }
  const Chain chain(std::move(spheres));
  SphereTree one, several;
  build_sphere_tree(chain.view(), one, {}, Team());
  build_sphere_tree(chain.view(), several, {},
                    Team(Parameters("test", {Team::threads_parameter()}, "threads=3")));
  EXPECT_TRUE(std::ranges::equal(one.index, several.index));
  for (std::size_t l = 0; l < one.boxes.size(); ++l)
    EXPECT_TRUE(std::ranges::equal(one.boxes[l], several.boxes[l]));
}

std::vector<Pair> pairs_of(const Chain& chain, const SphereTree& tree) {
  SphereQueues queues;
  return pairs_of(chain, tree, queues);
}

/// Later groups of nodes, and itself, that one's box meets.
std::uint32_t met_by(const SphereTree& tree, std::uint32_t g) {
  std::uint32_t met = 0;
  for (std::uint32_t other = g; other < tree.count(1); ++other) {
    bool apart = false;
    for (std::uint32_t d = 0; d < 3; ++d)
      apart |= field(tree, 1, g, d) > field(tree, 1, other, 3 + d) ||
               field(tree, 1, other, d) > field(tree, 1, g, 3 + d);
    met += !apart;
  }
  return met;
}

/// Nodes go down together, or each alone where one of their group meets very much, on every level there is;
/// and who loses a group on the way loses pairs.
TEST(SphereTree, FindsAllPairsWhereNodesGoTogetherOrAlone) {
  properties::Dice dice(11);
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < 80'000; ++k) {
    const bool great = k % 9'000 == 5'000;
    spheres.push_back({50 * dice.symmetric(), 50 * dice.symmetric(), 50 * dice.symmetric(),
                       great            ? 30.0f
                       : dice.one_in(3) ? 0.2f
                                        : 0.5f});
  }
  const Chain chain(std::move(spheres));
  SphereTree tree;
  build_sphere_tree(chain.view(), tree, {}, Team());
  std::uint32_t together = 0, alone = 0, several = 0;
  for (std::uint32_t g = 0; g < tree.count(1); ++g) {
    const std::uint32_t met = met_by(tree, g);
    ++(met < SphereQueues::group_limit ? together : alone);
    several += met > SphereTree::group && met < SphereQueues::group_limit;
  }
  EXPECT_GT(tree.boxes.size(), 3u);
  EXPECT_GT(together, 100u);
  EXPECT_GT(several, 10u);
  EXPECT_GT(alone, 0u);

  Collisions right;
  const auto other = StrategyRegistry::instance().make("Grid");
  other->build(chain);
  other->find(chain, {}, right);
  properties::sort(right.pairs);
  EXPECT_GT(right.pairs.size(), chain.size() / 2);
  EXPECT_TRUE(pairs_of(chain, tree) == right.pairs);

  const std::uint32_t lost = tree.count(1) / 2;
  tree.boxes_of(1, lost / SphereTree::group)[lost % SphereTree::group] =
      std::numeric_limits<float>::infinity();
  EXPECT_LT(pairs_of(chain, tree).size(), right.pairs.size());
}

}  // namespace
}  // namespace catena
