#include "catena/bench/margins/margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "catena/core/input/input.h"
#include "catena/reference/all_pairs.h"
#include "catena/reference/exact_gap.h"

namespace catena::bench {
namespace {

Chain scene(const std::string& spec) { return open_input(spec).animation->frame(0); }

/// The definition, pair by pair.
Margins by_definition(const Chain& chain) {
  Margins margins;
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 1; j < chain.size(); ++j) {
      if (chain.neighbours(i, j)) continue;
      const double m = reference::margin(chain[i], chain[j]);
      const bool collides = reference::overlap(chain[i], chain[j]);
      if (collides || m < 1) margins.add({i, j}, collides, m);
    }
  return margins;
}

TEST(Margins, AreThoseOfThePairByPairDefinition) {
  for (const char* spec : {"grazing:n=600,margin=1e-7", "lattice:n=600", "mixed_radii:n=600,decades=30",
                           "points:n=500,share=0.7", "winding:n=500", "largest:n=500", "smallest:n=500",
                           "far:n=600,exponent=24", "coincident:n=300", "yarn:n=600"}) {
    const Chain chain = scene(spec);
    const Margins found = margins_of(chain), right = by_definition(chain);
    EXPECT_EQ(found.colliding.pairs, right.colliding.pairs) << spec;
    EXPECT_EQ(found.apart.pairs, right.apart.pairs) << spec;
    EXPECT_EQ(found.colliding.decade, right.colliding.decade) << spec;
    EXPECT_EQ(found.apart.decade, right.apart.decade) << spec;
    EXPECT_EQ(found.touching, right.touching) << spec;
    EXPECT_EQ(found.open_in_binary32, right.open_in_binary32) << spec;
    EXPECT_EQ(found.open_in_binary64, right.open_in_binary64) << spec;
    EXPECT_EQ(found.tightest, right.tightest) << spec;
    if (right.least < 1e-3) {
      EXPECT_EQ(found.least, right.least) << spec;
    }
  }
}

/// By explicit numbers: everything else here adds by the same function.
TEST(Margins, AreCountedByTheirPowersOfTen) {
  Margins margins;
  for (const double margin : {0.0, 1e-300, 2e-12, 2e-3, 9e-3, 0.5, 7.0}) margins.add({0, 2}, true, margin);
  margins.add({0, 3}, false, 2e-5);
  std::array<std::uint64_t, Margins::decades> colliding{}, apart{};
  colliding[15] = 2, colliding[11] = 1, colliding[2] = 2, colliding[0] = 2, apart[4] = 1;
  EXPECT_EQ(margins.colliding.decade, colliding);
  EXPECT_EQ(margins.apart.decade, apart);
  EXPECT_EQ(margins.colliding.pairs, 7u);
  EXPECT_EQ(margins.apart.pairs, 1u);
  EXPECT_EQ(margins.touching, 1u);
}

/// Two spheres of radius 1, sqrt(2) apart: 2 - sqrt(2) = 0.586 must be lost for them to part.
TEST(Margins, AreOpenWhereRoundingCoversTheDepth) {
  const float side = 1;
  const Chain chain({{0, 0, 0, 1}, {50, 0, 0, 0}, {side, side, 0, 1}});
  for (const auto& [loss, open] : {std::pair{0.58, 0u}, {0.59, 1u}})  // sqrt(3) of it along each of both ways
    EXPECT_EQ(margins_of(chain, loss / (2 * std::sqrt(3.0))).open_by_rounding, open) << loss;
}

/// What the stages of the exact overlap leave open is where they stop deciding; of equal margins the least
/// pair is told.
TEST(Margins, CountWhatTheStagesLeaveOpenAndNameTheTightest) {
  for (const auto& [slack, open] :
       {std::pair{12 * 0x1p-24, &Margins::open_in_binary32}, {10 * 0x1p-53, &Margins::open_in_binary64}}) {
    Margins margins;
    margins.add({0, 2}, true, slack);
    EXPECT_EQ(margins.*open, 1u);
    margins.add({0, 3}, false, slack * 1.01);
    EXPECT_EQ(margins.*open, 1u);
    margins.add({0, 4}, false, slack * 0.99);
    EXPECT_EQ(margins.*open, 2u);
  }
  std::vector<Pair> pairs{{3, 9}, {1, 7}, {1, 5}, {2, 4}};
  std::ranges::sort(pairs);
  do {
    Margins margins;
    margins.add({0, 2}, true, 0.5);
    for (const Pair& pair : pairs) margins.add(pair, pair.i == 1, 0.25);
    EXPECT_EQ(margins.tightest, (Pair{1, 5}));
    EXPECT_TRUE(margins.tightest_collides);
    EXPECT_EQ(margins.least, 0.25);
  } while (std::ranges::next_permutation(pairs).found);
}

TEST(Margins, OfScenesAreThoseTheyWereMadeWith) {
  const Margins grazing = margins_of(scene("grazing:n=5000,margin=1e-4,align=axes"));
  EXPECT_GT(grazing.colliding.decade[3] + grazing.colliding.decade[4], 4000u);
  EXPECT_EQ(grazing.touching, 0u);
  const Margins lattice = margins_of(scene("lattice:n=1000,align=axes"));
  EXPECT_EQ(lattice.least, 0);
  EXPECT_EQ(lattice.touching, lattice.colliding.pairs);
  EXPECT_EQ(lattice.open_in_binary64, lattice.touching);
  const Margins apart = margins_of(scene("rod:n=100,spacing=3"));
  EXPECT_EQ(apart.colliding.pairs + apart.apart.pairs, 0u);
  EXPECT_TRUE(std::isinf(apart.least));
}

// Two spheres of radius 1, and 10 units of rounding either way: by it alone the pairs at 1.9 and 2.1 stay
// open.
TEST(Margins, SeeWhatTheRoundingOfAFileLeavesOpen) {
  const auto pair_at = [](float distance) {
    return Chain({{0, 0, 0, 1}, {distance, 0, 0, 1}}, {{0, 1, 2}, {0, 0}});
  };
  constexpr double reach = 0.1 + 1e-6, rounding = reach / (2 * 1.7320508075688772);
  for (const auto& [distance, open] : {std::pair(1.9f, 1u), {2.1f, 1u}, {2.0f, 1u}, {1.8f, 0u}, {2.2f, 0u}}) {
    EXPECT_EQ(margins_of(pair_at(distance), rounding).open_by_rounding, open) << distance;
    EXPECT_EQ(margins_of(pair_at(distance)).open_by_rounding, 0u) << distance;
  }
  EXPECT_EQ(margins_of(pair_at(2), rounding).rounding, rounding);
}

// A ring of boxes: what lies across a face has the margin that it has where the box is begun elsewhere.
TEST(Margins, InABoxAreThoseOfNearestImages) {
  const auto pair_at = [](float x) { return Chain({{0.5f, 0, 0, 1}, {x, 0, 0, 1}}, {{0, 1, 2}, {0, 0}}); };
  const PeriodicBox box{{16, 0, 0}};
  for (const auto& [across, within] :
       {std::pair(15.25f, -0.75f), {14.5f, -1.5f}, {14.25f, -1.75f}, {13.0f, -3.0f}}) {
    const Margins found = margins_of(pair_at(across), 0, &box), right = margins_of(pair_at(within));
    EXPECT_EQ(found.least, right.least) << across;
    EXPECT_EQ(found.colliding.decade, right.colliding.decade) << across;
    EXPECT_EQ(found.apart.decade, right.apart.decade) << across;
    EXPECT_EQ(found.touching, right.touching) << across;
  }
  EXPECT_EQ(margins_of(pair_at(14.5f), 0, &box).touching, 1u);
}

TEST(Margins, CountEachPairInOneDecade) {
  const Margins m = margins_of(scene("yarn:n=3000"));
  for (const auto& side : {m.colliding, m.apart})
    EXPECT_EQ(std::accumulate(side.decade.begin(), side.decade.end(), std::uint64_t{0}), side.pairs);
  EXPECT_EQ(m.colliding.pairs, reference::all_pairs(scene("yarn:n=3000")).answer.pair_count);
}

}  // namespace
}  // namespace catena::bench
