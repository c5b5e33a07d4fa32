#include "catena/core/blocks/window_filter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {
namespace {

/// Whatever the chain, the filter says what the chain says; and some chains let it tell pairs unseen.
TEST(WindowFilter, SaysWhatTheChainSays) {
  std::uint64_t seed = 0, neighbours = 0, strands = 0;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (int round = 0; round < 6; ++round) {
      properties::Dice dice(++seed);
      const Chain chain = properties::generate(family, dice, 40);
      const ChainView view = chain.view();
      const WindowFilter filter(view);
      strands += chain.strand_count() > 2;
      std::vector<Pair> all, kept;
      for (std::uint32_t j = 0; j < chain.size(); ++j)
        for (std::uint32_t i = 0; i < j; ++i) {
          EXPECT_EQ(filter.neighbours({i, j}), chain.neighbours(i, j)) << family.name << ' ' << i << ' ' << j;
          neighbours += chain.neighbours(i, j);
          all.push_back({i, j});
          if (!chain.neighbours(i, j)) kept.push_back({i, j});
        }
      EXPECT_TRUE(std::ranges::equal(filter.without_neighbours(all), kept)) << family.name;
    }
  EXPECT_GT(neighbours, 1000u);
  EXPECT_GT(strands, 5u);
}

/// Around the end of a closed strand neighbours are far apart in number.
TEST(WindowFilter, KnowsClosedStrandsAndExtraPairs) {
  std::vector<Sphere> spheres(12, Sphere{0, 0, 0, 1});
  const auto says = [&](const Chain& chain, Pair pair) {
    return WindowFilter(chain.view()).neighbours(pair);
  };
  EXPECT_FALSE(says(Chain(spheres, {{0, 6, 12}, {0, 0}}), {0, 5}));
  EXPECT_TRUE(says(Chain(spheres, {{0, 6, 12}, {2, 0}}), {0, 5}));
  Exclusion with_extra = Exclusion::index(1);
  with_extra.extra_pairs = {{1, 9}};
  EXPECT_TRUE(says(Chain(spheres, {{0, 6, 12}, {0, 0}}, with_extra), {1, 9}));
  EXPECT_FALSE(says(Chain(spheres, {{0, 6, 12}, {0, 0}}, with_extra), {2, 9}));
  EXPECT_FALSE(says(Chain(spheres, {{0, 6, 12}, {0, 0}}), {5, 6}));
}

/// A window may end at any sphere of a block, be it the last.
TEST(WindowFilter, LeavesWhatLiesBeyondALongWindow) {
  properties::Dice dice(1);
  std::vector<Sphere> spheres;
  const auto at = [&] { return static_cast<float>(6 * dice.unit()); };
  for (int k = 0; k < 400; ++k) spheres.push_back({at(), at(), at(), 1});
  for (const std::uint32_t window : {41u, 50u, 63u, 64u, 100u}) {
    const Chain chain(spheres, {}, Exclusion::index(window));
    const auto pairs = [&](const char* name) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      properties::sort(found.pairs);
      return found.pairs;
    };
    const std::vector<Pair> right = pairs("CPU1");
    for (const char* name : {"ChainTree", "Hybrid"})
      EXPECT_TRUE(pairs(name) == right) << name << ' ' << window;
  }
}

}  // namespace
}  // namespace catena
