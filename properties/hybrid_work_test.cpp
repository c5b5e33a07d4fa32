// What Hybrid does for an answer, what it leaves out, and what it tells of that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/hybrid/hybrid_search.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/allocations.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"

namespace catena::properties {
namespace {

/// What is told of a search is its own, however often it was made, and of each stage that it has.
TEST(Hybrid, TellsTheWorkOfTheLastSearchAlone) {
  struct Expected {
    const char *input, *variant;
    std::vector<std::size_t> stages;  // by their place in what is told
  };
  for (const auto& [input, name, stages] :
       {Expected{"path1:n=5000", "Hybrid", {0, 2}}, Expected{"yarn:n=20000", "Hybrid(dense=1000)", {1, 2}},
        Expected{"yarn:n=5000", "Hybrid(crowd=0,dense=0)", {4}},
        Expected{"mixed_radii:n=5000", "Hybrid(crowd=0,dense=0)", {3, 4}},
        Expected{"mixed_radii:n=5000", "SphereTree", {0, 1}}}) {
    const Chain chain = open_input(input).animation->frame(0);
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    variant->build(chain);
    variant->find(chain, {}, found);
    const auto once = variant->work();
    variant->find(chain, {}, found);
    const auto again = variant->work();
    ASSERT_EQ(once.size(), again.size());
    for (std::size_t k = 0; k < once.size(); ++k)
      EXPECT_EQ(once[k].times, again[k].times) << input << ' ' << once[k].step;
    for (const std::size_t k : stages) EXPECT_GT(once.at(k).times, 0u) << input << ' ' << once[k].step;
  }
}

/// Spheres are searched one by one or not, all of this chain, whatever was searched before.
TEST(Hybrid, CountsEachSphereOnceWhateverItSearchedBefore) {
  Dice dice(4);
  std::vector<Sphere> dust;
  for (std::uint32_t i = 0; i < 4000; ++i)
    dust.push_back({50 * dice.symmetric(), 50 * dice.symmetric(), 50 * dice.symmetric(), 0.5f});
  const Chain sparse(std::move(dust)), row = open_input("path1:n=4000").animation->frame(0);
  HybridSearch search({64, 1}, 1);
  const Team team;
  for (int turn = 0; turn < 2; ++turn) {
    search.build(sparse.view(), team);
    EXPECT_EQ(search.work().dense, sparse.size());
    search.build(row.view(), team);
    EXPECT_EQ(search.work().dense, 0u);
  }
}

/// Pairs of which binary32 is certain go to the exact stage too, where that may not be left out.
TEST(Hybrid, AsksTheExactStageOfAllInEachOfItsSearches) {
  for (const char* input : {"path1:n=5000", "yarn:n=5000", "mixed_radii:n=5000"})
    for (const char* settings : {"", "crowd=0,dense=0", "crowd=0,dense=1000"}) {
      const Chain chain = open_input(input).animation->frame(0);
      const auto open_pairs = [&](const std::string& with) {
        const auto variant = StrategyRegistry::instance().make("Hybrid(" + with + ")");
        Collisions found;
        variant->build(chain);
        variant->find(chain, {}, found);
        std::ranges::sort(found.pairs);
        return std::pair(variant->work().back().times, found.pairs);
      };
      const std::string more = *settings == 0 ? "" : std::string(",") + settings;
      const auto [usual, pairs] = open_pairs("exact=open" + more);
      const auto [all, same_pairs] = open_pairs("exact=all" + more);
      ASSERT_FALSE(pairs.empty()) << input;
      EXPECT_EQ(pairs, same_pairs) << input << ' ' << settings;
      EXPECT_GE(all, pairs.size()) << input << ' ' << settings;
      EXPECT_GT(all, usual) << input << ' ' << settings;
    }
}

/// What may not be left out is done, and the plan says so.
TEST(Hybrid, DoesWhatItIsToldTo) {
  const auto left_out = [](const char* input, const std::string& name, const char* step) {
    const Chain chain = open_input(input).animation->frame(0);
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    variant->build(chain);
    variant->find(chain, {}, found);
    const Plan plan = variant->plan();
    const auto at = std::ranges::find(plan, step, &Decision::step);
    EXPECT_NE(at, plan.end()) << step;
    return at != plan.end() && at->left_out;
  };
  EXPECT_TRUE(left_out("path1:n=5000", "Hybrid", "search within straight stretches"));
  EXPECT_FALSE(left_out("path1:n=5000", "Hybrid(rows=search)", "search within straight stretches"));
  EXPECT_TRUE(left_out("yarn:n=5000", "Hybrid(crowd=0,dense=0)", "radius of each sphere in cells"));
  EXPECT_FALSE(
      left_out("yarn:n=5000", "Hybrid(crowd=0,dense=0,radii=each)", "radius of each sphere in cells"));
  EXPECT_TRUE(left_out("path1:n=5000", "Hybrid", "order of space"));
  EXPECT_FALSE(left_out("yarn:n=20000", "Hybrid(dense=1000)", "order of space"));
  EXPECT_TRUE(left_out("path1:n=5000", "Hybrid", "single spheres"));
  EXPECT_FALSE(left_out("yarn:n=5000", "Hybrid(crowd=0,dense=0)", "single spheres"));
}

/// A walk on a ball's surface is everywhere alike, and searched about as fast in the chain's order as by
/// single spheres: what chance makes of some parts is no reason for two orders.
TEST(Hybrid, TakesOneOrderWhereTwoWouldSaveNothing) {
  constexpr std::uint32_t n = 30'000;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Dice dice(seed);
    const double room = std::sqrt(n / (0.4 * 4 * M_PI));
    double at[3] = {0, 0, room}, way[3] = {1, 0, 0};
    const auto to_length = [](double(&v)[3], double length) {
      const double times = length / std::hypot(v[0], v[1], v[2]);
      for (double& x : v) x *= times;
    };
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) {
      spheres.push_back(
          {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]), 0.5f});
      for (double& x : way) x += 0.3 * dice.symmetric();
      to_length(way, 1);
      for (int d = 0; d < 3; ++d) at[d] += way[d];
      to_length(at, room);
    }
    const auto hybrid = StrategyRegistry::instance().make("Hybrid");
    const Chain chain(std::move(spheres));
    Collisions found;
    hybrid->build(chain);
    hybrid->find(chain, {}, found);
    for (const Decision& step : hybrid->plan()) {
      EXPECT_TRUE(step.step != "order of space" || step.left_out) << step.reason;
    }
  }
}

/// Rods of a node and a half that cross one another anywhere: some nodes meet more than two thirds of all,
/// and look into hardly any. No other order is worth making.
TEST(Hybrid, KeepsTheChainsOrderOfRodsThatCross) {
  constexpr std::uint32_t rod = 200, n = 60 * rod;
  Dice dice(3);
  std::vector<Sphere> spheres;
  Strands strands;
  for (std::uint32_t i = 0; i < n; i += rod) {
    double at[3], way[3];
    for (double& x : at) x = 70 * dice.symmetric();
    do
      for (double& x : way) x = dice.symmetric();
    while (std::hypot(way[0], way[1], way[2]) > 1);
    const double step = 1.5 / std::hypot(way[0], way[1], way[2]);
    strands.first.push_back(i);
    for (int k = 0; k < int{rod}; ++k) {
      const double t = (k - rod / 2.0) * step;
      spheres.push_back({static_cast<float>(at[0] + t * way[0]), static_cast<float>(at[1] + t * way[1]),
                         static_cast<float>(at[2] + t * way[2]), 1});
    }
  }
  strands.first.push_back(n);
  const Chain chain(std::move(spheres), std::move(strands));
  const auto hybrid = StrategyRegistry::instance().make("Hybrid");
  Collisions found;
  hybrid->build(chain);
  hybrid->find(chain, {}, found);
  EXPECT_GT(found.pair_count, 100u);
  EXPECT_TRUE(reference::compare(chain, reference::find(chain), found).right());
  for (const Decision& step : hybrid->plan()) {
    EXPECT_TRUE(step.left_out || (step.step != "order of space" && step.step != "single spheres"))
        << step.reason;
  }
}

/// Where the first look, at two of 32 groups of nodes, sees straight ones alone, the walk meets the tangle
/// that the others are: it is told from the rest before each of its nodes has met more than the limit.
TEST(Hybrid, LeavesATangleOutOnceTheWalkHasMetIt) {
  constexpr std::uint32_t group = 16 * 128, groups = 32, n = groups * group;
  const auto straight = [](std::uint32_t g) { return (7 <= g && g <= 9) || g >= 24; };
  Dice dice(7);
  double at[3] = {0, 0, 0}, way[3] = {1, 0, 0};
  const auto length = [](const double(&v)[3]) { return std::hypot(v[0], v[1], v[2]); };
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (straight(i / group)) {
      spheres.push_back({static_cast<float>(i), 100, 0, 0.5f});
      continue;
    }
    const double times = length(way);
    for (int d = 0; d < 3; ++d) at[d] += way[d] / times;
    spheres.push_back(
        {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]), 0.5f});
    const bool outside = length(at) > 12;
    for (int d = 0; d < 3; ++d) way[d] += 0.5 * dice.symmetric() - (outside ? 0.05 * at[d] : 0);
  }
  const Chain chain(std::move(spheres));
  HybridSearch search({64, 1}, 1);
  const Team team;
  search.build(chain.view(), team);
  const Crowding& crowding = search.parts().crowding;
  EXPECT_EQ(crowding.nodes(), groups * 16);
  EXPECT_GT(crowding.crowded_nodes(), 20u * 16);
  EXPECT_LT(crowding.pair_count(), std::size_t{6} * crowding.nodes());
  const auto hybrid = StrategyRegistry::instance().make("Hybrid");
  Collisions found;
  hybrid->build(chain);
  hybrid->find(chain, {}, found);
  EXPECT_GT(found.pair_count, 10'000u);
  EXPECT_TRUE(reference::compare(chain, reference::find(chain), found).right());
}

/// Strands that are short and lie anywhere are searched one by one in wide cells before any tree is built;
/// laid out side by side, in the chain's order.
TEST(Hybrid, BuildsNoTreeOfShortStrandsThatLieAnywhere) {
  constexpr std::uint32_t strand = 12, n = 12'000;
  for (const bool anywhere : {true, false}) {
    Dice dice(5);
    std::vector<Sphere> spheres;
    Strands strands;
    for (std::uint32_t i = 0; i < n; i += strand) {
      const std::uint32_t s = i / strand;
      const auto at = [&] { return 25 * dice.symmetric(); };
      const float y = anywhere ? at() : 1.1f * static_cast<float>(s), z = anywhere ? at() : 0,
                  x = anywhere ? at() : 0;
      strands.first.push_back(i);
      for (std::uint32_t k = 0; k < strand; ++k) spheres.push_back({x + static_cast<float>(k), y, z, 0.5f});
    }
    strands.first.push_back(n);
    const Chain chain(std::move(spheres), std::move(strands));
    HybridSearch search({64, 1}, 1);
    search.build(chain.view(), Team());
    EXPECT_EQ(search.nodes() == 0, anywhere);
    EXPECT_EQ(search.work().dense, anywhere ? n : 0u);
  }
}

/// Blocks or single spheres, as measured to be quicker by a fifth or more.
TEST(Hybrid, TakesTheQuickerOfBlocksAndSingleSpheres) {
  const auto single = [](const std::string& input) {
    const Chain chain = open_input(input).animation->frame(0);
    HybridSearch search({64, 1}, 1);
    search.build(chain.view(), Team());
    return static_cast<double>(search.work().dense) / chain.size();
  };
  EXPECT_EQ(single("tight_knot:p=2,margin=1e-2,n=20000"), 0) << "what is near are mostly neighbours";
  EXPECT_EQ(single("serpentine:n=10000"), 0) << "many pairs, which are quicker block by block";
  EXPECT_EQ(single("hair:n=3000,strands=100"), 0) << "few strands of thirty";
  EXPECT_EQ(single("cluster:n=20000"), 1) << "the most unlike radii";
  EXPECT_EQ(single("yarn:n=20000"), 1);
}

/// What one frame has no need of another may need again, and its memory is there.
TEST(Hybrid, AllocatesNothingWhereFramesAreCrowdedByTurns) {
  const Allocations::Read calls = Allocations::counter();
  if (calls == nullptr) GTEST_SKIP() << "this program does not count allocations";
  constexpr std::uint32_t n = 3000;
  Dice dice(1);
  std::vector<Sphere> dust, line;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto at = [&] { return 7 * dice.symmetric(); };
    dust.push_back({at(), at(), at(), 0.5f});
    line.push_back({static_cast<float>(i), 0, 0, 0.5f});
  }
  const Chain crowded(std::move(dust)), apart(std::move(line));
  const auto hybrid = StrategyRegistry::instance().make("Hybrid");
  hybrid->build(crowded);
  for (const Chain* frame : {&apart, &crowded, &apart}) hybrid->update(*frame);
  for (const Chain* frame : {&crowded, &apart, &crowded}) {
    const std::uint64_t before = calls();
    hybrid->update(*frame);
    EXPECT_EQ(calls() - before, 0u) << (frame == &apart ? "apart" : "crowded");
    Collisions found;
    hybrid->find(*frame, {}, found);
    const reference::Answer right = reference::find(*frame);
    sort(found.pairs);
    EXPECT_EQ(found.pairs, right.pairs);
    EXPECT_EQ(right.pair_count > 0, frame == &crowded);
  }
}

}  // namespace
}  // namespace catena::properties
