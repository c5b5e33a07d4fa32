#include "catena/core/blocks/neighbour_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/chain/chain.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/exact_gap.h"
#include "catena/reference/reference.h"

namespace catena {
namespace {

/// A finely sampled tube that turns, of some strands.
Chain fine_tube(properties::Dice& dice, std::uint32_t n, Exclusion rule) {
  std::vector<Sphere> spheres;
  Strands strands{{0}, {}};
  double x = 0, y = 0, turn = 0;
  const float radius = 0.5f + 2 * dice.unit(), spread = dice.one_in(2) ? 0.0f : 0.3f * dice.unit();
  while (spheres.size() < n) {
    for (std::uint32_t k = 1 + static_cast<std::uint32_t>(dice.between(0, 400)); k > 0 && spheres.size() < n;
         --k) {
      turn += 0.02 * dice.symmetric();
      x += 0.1 * std::cos(turn), y += 0.1 * std::sin(turn);
      spheres.push_back({static_cast<float>(x), static_cast<float>(y), 0.01f * dice.symmetric(),
                         radius * (1 + spread * dice.unit())});
    }
    strands.first.push_back(static_cast<std::uint32_t>(spheres.size()));
    strands.closed.push_back(dice.one_in(4));
  }
  return Chain(std::move(spheres), std::move(strands), std::move(rule));
}

Exclusion some_rule(properties::Dice& dice) {
  return dice.one_in(2) ? Exclusion::index(static_cast<std::uint32_t>(dice.between(1, 300)))
                        : Exclusion::arc(0.2 + 4 * dice.unit());
}

bool all_neighbours(const Chain& chain, const BlockTree& tree, std::uint32_t a, std::uint32_t b) {
  for (std::uint32_t i = tree.begin_of(a); i < tree.end_of(a); ++i)
    for (std::uint32_t j = tree.begin_of(b); j < tree.end_of(b); ++j)
      if (i != j && !chain.neighbours(i, j)) return false;
  return true;
}

TEST(NeighbourBlocks, HoldNothingElse) {
  std::uint64_t found = 0, missed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    properties::Dice dice(seed);
    const Chain chain = fine_tube(dice, 600, some_rule(dice));
    BlockTree tree;
    build_block_tree(chain.view(), tree, Team());
    const ChainView view = chain.view();
    const NeighbourBlocks blocks(view, tree);
    for (std::uint32_t a = 0; a < tree.blocks; ++a) {
      for (std::uint32_t b = a; b < tree.blocks; ++b) {
        const bool all = blocks.all(a, b), true_of_all = all_neighbours(chain, tree, a, b);
        EXPECT_TRUE(!all || true_of_all) << seed << ' ' << a << ' ' << b;
        found += all, missed += true_of_all && !all;
      }
      for (std::uint32_t g = a / BlockTree::group; g < tree.level[0].count; ++g) {
        std::uint32_t lanes = 0;
        for (std::uint32_t k = 0; k < tree.blocks_of(g); ++k)
          if (const std::uint32_t b = g * BlockTree::group + k; b >= a && blocks.all(a, b)) lanes |= 1u << k;
        EXPECT_EQ(blocks.lanes(a, g), lanes) << seed << ' ' << a << ' ' << g;
      }
    }
  }
  EXPECT_GT(found, 10'000u);
  EXPECT_LT(missed, found / 4) << "radii differ, strands are closed, and blocks are not full";
}

/// Beads on a string, but for four: a large one, two beyond its neighbour, of which the first ends just
/// beyond it and the last lies back, within it. Wherever in a block they are, that pair is found, and nothing
/// else.
TEST(NeighbourBlocks, OfBeadsThatTurnBackAreCompared) {
  constexpr std::uint32_t n = 48;
  for (const char* const name : {"ChainTree", "Hybrid(crowd=0)"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    for (std::uint32_t i = 0; i + 4 < n; ++i) {
      std::vector<Sphere> spheres;
      for (std::uint32_t k = 0; k < n; ++k) spheres.push_back({10 * static_cast<float>(k), 0, 0, 0.5f});
      const float x = spheres[i].x;
      spheres[i].radius = 5, spheres[i + 1] = {x + 2, 0, 0, 0.1f};
      spheres[i + 2].x = x + 6, spheres[i + 3].x = x + 4;
      const Chain chain(std::move(spheres));
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      EXPECT_EQ(found.pairs, (std::vector<Pair>{{i, i + 3}})) << name;
    }
  }
}

/// Small beads far apart along any direction, but for three in each block, of which the outer two just touch:
/// by less than what is rounded where they are.
TEST(NeighbourBlocks, OfBeadsThatJustTouchAreCompared) {
  properties::Dice dice(7);
  for (int chains = 0; chains < 20; ++chains) {
    const double u[] = {0.5 + dice.unit(), dice.symmetric(), dice.symmetric()};
    std::vector<Sphere> spheres;
    std::vector<Pair> touching;
    double t = -5;
    for (std::uint32_t i = 0; i < 96; ++i) {
      const bool close = i % 8 == 3 || i % 8 == 4;
      t += close ? 1e-4 : 0.1 + 0.1 * dice.unit();
      spheres.push_back(
          {static_cast<float>(t * u[0]), static_cast<float>(t * u[1]), static_cast<float>(t * u[2]), 5e-5f});
      if (i % 8 != 4) continue;
      Sphere &first = spheres[i - 2], &last = spheres[i];
      first.radius = last.radius = static_cast<float>(
          std::hypot(double{first.x} - last.x, double{first.y} - last.y, double{first.z} - last.z) / 2.00001);
      while (!reference::overlap(first, last))
        first.radius = last.radius = std::nextafter(first.radius, 1.0f);
      touching.push_back({i - 2, i});
    }
    const Chain chain(std::move(spheres));
    for (const char* const name : {"ChainTree", "Hybrid(crowd=0)"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      properties::sort(found.pairs);
      EXPECT_EQ(found.pairs, touching) << name;
    }
  }
}

/// What has nothing but neighbours is not compared, in no search by blocks; and nothing is lost.
TEST(NeighbourBlocks, AreNotCompared) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    properties::Dice dice(seed);
    const Chain chain = fine_tube(dice, 3000, some_rule(dice));
    auto right = reference::find(chain).pairs;
    properties::sort(right);
    for (const char* const name : {"ChainTree", "Hybrid", "Hybrid(crowd=0)", "Hybrid(crowd=0,dense=1e6)"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      properties::sort(found.pairs);
      EXPECT_EQ(found.pairs, right) << name << ' ' << seed;
    }
  }
  properties::Dice dice(1);
  for (Exclusion rule : {Exclusion::index(100), Exclusion::arc(1.6)}) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 4000; ++i) spheres.push_back({0.02f * static_cast<float>(i), 0, 0, 0.5f});
    const Chain chain(std::move(spheres), {}, rule);
    for (const char* const name : {"ChainTree", "Hybrid"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      for (const WorkDone& step : variant->work()) {
        EXPECT_TRUE(step.step != "eight spheres, eight" || step.times < 1000) << name;
      }
      EXPECT_EQ(found.pairs.size(), 0u);
    }
  }
}

}  // namespace
}  // namespace catena
