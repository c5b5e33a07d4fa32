// Every border between the three searches of Hybrid, wherever it is drawn: short chains meet them all where
// little is called crowded, and little or much dense.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/hybrid/hybrid_search.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/reference.h"

namespace catena::properties {
namespace {

struct Spread {
  bool chain_order = false, space_order = false, cells = false, all = false;
};

void expect_exact(const Chain& chain, const std::string& what, Spread& spread) {
  const reference::Answer right = reference::find(chain);
  const Team alone, several(Parameters("test", {Team::threads_parameter()}, "threads=3"));
  const Team& team = chain.size() > 10000 ? several : alone;  // of which each gathers some
  for (const std::uint32_t crowd : {0u, 1u, 4u})
    for (const double dense : {0.0, 0.4, 0.7, 1.0, 1.4, 2.0, 1e6}) {
      HybridSearch search({crowd, dense}, team.size());
      search.build(chain.view(), team);
      Collisions found;
      PairCollector collector(chain.size(), {}, found, team.size());
      search.search(chain.view(), collector, team);
      collector.finish();
      sort(found.pairs);
      EXPECT_TRUE(found.pairs == right.pairs && found.count == right.count)
          << what << ", crowd " << crowd << ", dense " << dense << ": " << found.pairs.size()
          << " pairs, right " << right.pairs.size();
      const HybridSearch::Work work = search.work();
      if (right.pair_count == 0) continue;
      const bool cells = work.tests > 0, space = work.entries > 0,
                 tree = search.crowded_nodes() < search.nodes();
      spread.chain_order |= tree, spread.space_order |= space, spread.cells |= cells;
      spread.all |= tree && space && cells;
    }
}

TEST(Hybrid, IsExactWhereverItsBordersAre) {
  Spread spread;
  std::uint64_t seed = 100;
  for (const Family& family : FamilyRegistry::instance().families())
    for (const std::uint32_t size : {300u, 1500u}) {
      Dice dice(++seed);
      expect_exact(generate(family, dice, size), family.name, spread);
    }
  EXPECT_TRUE(spread.chain_order);
  EXPECT_TRUE(spread.space_order);
  EXPECT_TRUE(spread.cells);
}

/// Walks of all kinds beside one another: straight, tangled, with jumps, thick and thin.
std::vector<Sphere> patchwork(Dice& dice, std::uint32_t pieces) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < pieces; ++k) {
    const float size = dice.one_in(3) ? 0.2f : 1.0f, room = dice.pick({3.0f, 20.0f, 100.0f});
    const std::uint32_t length = 1 + dice.below(400);
    const bool straight = dice.one_in(3), jumps = dice.one_in(4);
    float at[3] = {room * dice.symmetric(), room * dice.symmetric(), room * dice.symmetric()};
    float way[3] = {dice.symmetric(), dice.symmetric(), dice.symmetric()};
    for (std::uint32_t i = 0; i < length; ++i) {
      spheres.push_back({at[0], at[1], at[2], size * (0.5f + 0.5f * dice.unit())});
      for (int d = 0; d < 3; ++d) {
        if (!straight) way[d] = dice.symmetric() - 0.1f * at[d] / room;
        at[d] += size * way[d];
        if (jumps && dice.one_in(50)) at[d] = room * dice.symmetric();
      }
    }
  }
  return spheres;
}

/// What binary32 is certain of is left out of the exact stage, and what a chain tells of all its spheres is
/// not asked of each: with it the pairs are the same, by each search.
TEST(Hybrid, IsExactWithWhatItLeavesOutAndWithout) {
  std::uint64_t seed = 200, open = 0, all = 0;
  for (const Family& family : FamilyRegistry::instance().families()) {
    Dice dice(++seed);
    const Chain chain = generate(family, dice, 700);
    const reference::Answer right = reference::find(chain);
    for (const char* name : {"Hybrid",
                             "Hybrid(exact=all)",
                             "Hybrid(crowd=0,dense=1e6,exact=all)",
                             "Hybrid(crowd=0,dense=0,exact=all)",
                             "ChainTree(exact=all)",
                             "Grid(exact=all)",
                             "auto(keep=exact)",
                             "Hybrid(crowd=0,dense=0,radii=each)",
                             "Grid(radii=each)",
                             "auto(keep=radii)",
                             "CPU1(range=checked)",
                             "CPU1(strands=read)",
                             "Hybrid(strands=read)",
                             "Hybrid(crowd=0,dense=1e6,strands=read)",
                             "Hybrid(crowd=0,dense=0,strands=read)",
                             "ChainTree(strands=read)",
                             "Grid(strands=read)",
                             "SphereTree(strands=read)",
                             "DeviceHybrid@host(range=checked)",
                             "DeviceGrid@host(range=checked)",
                             "auto(keep=strand-table+range-checks)"}) {
      const auto variant = StrategyRegistry::instance().make(name);
      Collisions found;
      variant->build(chain);
      variant->find(chain, {}, found);
      sort(found.pairs);
      EXPECT_TRUE(found.pairs == right.pairs && found.count == right.count) << family.name << ' ' << name;
      for (const WorkDone& done : variant->work())
        if (done.step == "pair of spheres, beyond binary32")
          (std::string(name).find("exact=all") == std::string::npos ? open : all) += done.times;
    }
  }
  EXPECT_GT(open, 0u);
  EXPECT_GT(all, 5 * open);
}

/// Rings told as one chain: it jumps from where one ends, beside where it began.
TEST(Hybrid, IsExactWhereTheChainJumps) {
  Spread spread;
  for (const std::uint32_t ring : {37u, 40u, 43u})
    for (const std::uint32_t window : {1u, 5u, 12u}) {
      std::vector<Sphere> spheres;
      for (std::uint32_t i = 0; i < 30 * ring; ++i) {
        const double angle = 2 * M_PI * (i % ring) / ring, around = ring / (2 * M_PI);
        spheres.push_back({static_cast<float>(around * std::cos(angle)),
                           static_cast<float>(around * std::sin(angle)), static_cast<float>(30 * (i / ring)),
                           1.1f});
      }
      expect_exact(Chain(spheres, {}, Exclusion::index(window)), "rings of " + std::to_string(ring), spread);
    }
  EXPECT_TRUE(spread.space_order);
}

TEST(Hybrid, IsExactOnPatchworks) {
  Spread spread;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Dice dice(seed);
    std::vector<Sphere> spheres = patchwork(dice, 20 + dice.below(60));
    const auto n = static_cast<std::uint32_t>(spheres.size());
    Strands strands;
    if (dice.one_in(2))
      for (std::uint32_t at = 0; at < n; at += 1 + dice.below(n / 2)) strands.first.push_back(at);
    if (!strands.first.empty()) strands.first.push_back(n);
    const Exclusion rule = dice.one_in(3) ? Exclusion::arc(1 + 3 * dice.unit())
                                          : Exclusion::index(dice.pick({1u, 2u, 6u, 9u, 40u}));
    expect_exact(Chain(std::move(spheres), std::move(strands), rule), "patchwork " + std::to_string(seed),
                 spread);
  }
}

/// Laid out, then loosely wound, then tightly, each within reach of the others.
std::vector<Sphere> three_parts() {
  Dice dice(77);
  std::vector<Sphere> spheres;
  float at[3] = {-32000, 0, 0}, way[3] = {1, 0, 0};
  const auto wind = [&](std::uint32_t steps, float turn, float pull) {
    for (std::uint32_t i = 0; i < steps; ++i) {
      spheres.push_back({at[0], at[1], at[2], 1});
      float length = 0;
      for (int d = 0; d < 3; ++d) {
        way[d] += turn * dice.symmetric() - pull * at[d];
        length += way[d] * way[d];
      }
      for (int d = 0; d < 3; ++d) {
        way[d] /= std::sqrt(length);
        at[d] += 1.6f * way[d];
      }
    }
  };
  wind(20000, 0, 0);
  wind(14000, 0.2f, 0.0006f);
  wind(6000, 0.5f, 0.02f);
  return spheres;
}

/// One object on chains of all kinds, longer and shorter by turns: no list, tree or count of one is the next
/// one's.
TEST(Hybrid, AnswersWhateverItSearchedBefore) {
  std::vector<Chain> chains;
  std::vector<reference::Answer> right;
  Dice dice(9);
  for (std::uint32_t k = 0; k < 9; ++k) {
    std::vector<Sphere> spheres = k == 8   ? std::vector<Sphere>()
                                  : k == 4 ? three_parts()
                                           : patchwork(dice, 3 + 6 * (k % 4));
    const auto n = static_cast<std::uint32_t>(spheres.size());
    Strands strands;  // every other chain has blocks that are half empty
    if (k % 2 == 1)
      for (std::uint32_t at = 0; at < n; at += 1 + dice.below(5)) strands.first.push_back(at);
    if (!strands.first.empty()) strands.first.push_back(n);
    chains.emplace_back(std::move(spheres), std::move(strands));
    right.push_back(reference::find(chains.back()));
  }
  const Team alone;
  std::size_t some_dense = 0, all_dense = 0;
  for (const std::uint32_t crowd : {0u, 1u, 4u})
    for (const double dense : {0.0, 0.3, 0.5, 0.7, 1.0, 1e6}) {
      HybridSearch search({crowd, dense}, 1);
      for (int turn = 0; turn < 20; ++turn) {
        const std::size_t k = dice.below(9);
        search.build(chains[k].view(), alone);
        Collisions found;
        PairCollector collector(chains[k].size(), {}, found);
        search.search(chains[k].view(), collector, alone);
        collector.finish();
        some_dense += search.work().dense > 0 && search.work().dense < chains[k].size();
        all_dense += search.work().dense == chains[k].size();
        sort(found.pairs);
        ASSERT_TRUE(found.pairs == right[k].pairs && found.count == right[k].count)
            << "chain " << k << ", crowd " << crowd << ", dense " << dense << ", turn " << turn;
      }
    }
  EXPECT_GT(some_dense, 0u);
  EXPECT_GT(all_dense, 0u);
}

TEST(Hybrid, IsExactWhereAllThreeSearchesMeet) {
  Spread spread;
  expect_exact(Chain(three_parts()), "three parts", spread);
  EXPECT_TRUE(spread.all) << "it was not shared out among all three";
}

}  // namespace
}  // namespace catena::properties
