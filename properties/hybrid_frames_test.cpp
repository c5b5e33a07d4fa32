#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/hybrid/hybrid_search.h"
#include "catena/core/space_tree/told_order.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/forced_target.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"

// What Hybrid keeps of a frame for the next: orders in space, and looks.
namespace catena::properties {
namespace {

using Spheres = std::vector<Sphere>;

/// A tube that winds about itself.
Spheres wound(std::uint32_t n) {
  Dice dice(3);
  Spheres spheres;
  float at[3] = {0, 0, 0}, way[3] = {1, 0, 0};
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back({at[0], at[1], at[2], i % 64 < 40 ? 1.0f : 0.4f});
    float length = 0;
    for (int d = 0; d < 3; ++d) way[d] += 0.3f * dice.symmetric() - 0.02f * at[d], length += way[d] * way[d];
    for (int d = 0; d < 3; ++d) way[d] /= std::sqrt(length), at[d] += 1.2f * way[d];
  }
  return spheres;
}

/// These are in a row, far from all others.
void lay_out(Spheres& spheres, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i)
    spheres[i] = {500 + 2.5f * static_cast<float>(i), 9000, 0, spheres[i].radius};
}

std::vector<Pair> pairs_of(HybridSearch& search, const Chain& chain) {
  Collisions found;
  PairCollector collector(chain.size(), {}, found);
  search.search(chain.view(), collector, Team());
  collector.finish();
  sort(found.pairs);
  return found.pairs;
}
std::vector<Pair> right_pairs(const Chain& chain) {
  Collisions found;
  const auto other = StrategyRegistry::instance().make("SweepAndPrune");
  other->build(chain);
  other->find(chain, {}, found);
  sort(found.pairs);
  return found.pairs;
}

/// By what it is told that was built.
void expect_told(const HybridSearch& search, const HybridSearch::Parts& parts) {
  std::uint32_t sorted = 0, frames = 0;
  if (parts.space.entries > 0) sorted += parts.space.entries, frames = parts.space.kept.frames();
  if (parts.dense_count > 0 && !parts.in_cells)
    sorted += parts.dense_count, frames = std::max(frames, parts.spheres.kept.frames());
  const Decision told = search.told_order(), right = told_order(sorted, frames);
  EXPECT_EQ(told.left_out, right.left_out);
  EXPECT_EQ(told.reason, right.reason);
}

/// Now one half of the chain is wound as the other was in the frame before, now less of it: what was kept is
/// of other blocks, or spheres, of which there are as many, or fewer.
TEST(HybridFrames, AreExactWhereOthersLieAsSomeDidBefore) {
  constexpr std::uint32_t half = 4096;  // of which the nodes above nodes are all wound, or none
  const Spheres coil = wound(half);
  const auto halves = [&](bool first, std::uint32_t straight) {
    Spheres spheres = coil;
    spheres.insert(spheres.end(), coil.begin(), coil.end());
    lay_out(spheres, first ? half - straight : 0, first ? 2 * half : half);
    if (!first) lay_out(spheres, 2 * half - straight, 2 * half);
    return Chain(std::move(spheres));
  };
  const std::vector<Chain> chains{halves(true, 0), halves(false, 0), halves(false, half / 4),
                                  halves(true, half / 4)};
  std::vector<std::vector<Pair>> right;
  for (const Chain& chain : chains) right.push_back(right_pairs(chain));
  for (const double dense : {1e6, 0.1}) {
    HybridSearch search({1, dense}, 1);
    const HybridSearch::Parts& parts = search.parts();
    std::uint32_t in_space = 0, spheres = 0;
    for (const std::size_t k : {0, 1, 1, 2, 3, 0, 0}) {
      search.build(chains[k].view(), Team(), SpaceSort::where_needed);
      EXPECT_TRUE(pairs_of(search, chains[k]) == right[k]) << dense << ", chain " << k;
      expect_told(search, parts);
      in_space += parts.space.entries > 0 && parts.space.kept.frames() > 0;
      spheres += parts.dense_count > 0 && !parts.in_cells && parts.spheres.kept.frames() > 0;
    }
    EXPECT_EQ(in_space > 0, dense > 1) << "what nobody keeps tests nothing";
    EXPECT_EQ(spheres > 0, dense < 1);
    search.build(chains[0].view(), Team());
    EXPECT_FALSE(search.told_order().left_out) << "a build sorts";
    EXPECT_TRUE(pairs_of(search, chains[0]) == right[0]);
  }
}

/// What a look told holds while little moves, and no longer.
TEST(HybridFrames, AreLookedAtAgainWhereMuchMoved) {
  constexpr float side = 7;
  Dice dice(4);
  Spheres dust, loose_dust, row;
  for (std::uint32_t i = 0; i < 8000; ++i) {
    dust.push_back({side * dice.symmetric(), side * dice.symmetric(), side * dice.symmetric(), 0.5f});
    loose_dust.push_back({2 * dust[i].x, 2 * dust[i].y, 2 * dust[i].z, 0.5f});
    row.push_back({static_cast<float>(i), 0, 0, 0.5f});
  }
  const Chain crowded(dust), loose(loose_dust), apart(row);
  const std::map<const Chain*, std::vector<Pair>> right{
      {&crowded, right_pairs(crowded)}, {&loose, right_pairs(loose)}, {&apart, right_pairs(apart)}};
  for (const std::int64_t target : targets_here()) {
    const ForcedTarget forced(target);
    HybridSearch search({64, 1}, 1);
    for (const Chain* frame : {&crowded, &crowded, &apart, &apart, &loose, &loose, &apart, &crowded}) {
      search.build(frame->view(), Team(), SpaceSort::where_needed);
      EXPECT_EQ(search.nodes() > 0, frame == &apart) << target;
      EXPECT_EQ(search.parts().dense_count > 0 && search.parts().in_cells, frame == &crowded) << target;
      EXPECT_TRUE(pairs_of(search, *frame) == right.at(frame)) << target;
      expect_told(search, search.parts());
    }
  }
}

}  // namespace
}  // namespace catena::properties
