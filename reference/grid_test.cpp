#include "catena/reference/grid.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include "catena/core/error.h"
#include "catena/reference/all_pairs.h"
#include "catena/reference/exact_gap.h"
#include "catena/reference/reference.h"
#include "catena/reference/testing/nasty.h"

namespace catena::reference {
namespace {

/// The definition itself, in a double loop that shares nothing with the search of all_pairs.
AllPairs by_definition(const Chain& chain) {
  AllPairs result;
  result.answer.count.assign(chain.size(), 0);
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 1; j < chain.size(); ++j) {
      if (chain.neighbours(i, j)) continue;
      const double m = margin(chain[i], chain[j]);
      if (m < result.tightest.margin) result.tightest = {{i, j}, m};
      if (gap_sign_by_integers(chain[i], chain[j]) > 0) continue;
      ++result.answer.count[i], ++result.answer.count[j], ++result.answer.pair_count;
      result.answer.pairs.push_back({i, j});
    }
  return result;
}

rc::Gen<Chain> nasty_chain() {
  return rc::gen::apply(
      [](std::vector<Sphere> spheres, std::uint32_t window, bool closed) {
        const auto n = static_cast<std::uint32_t>(spheres.size());
        return Chain(std::move(spheres), closed ? Strands::one_closed(n) : Strands{},
                     Exclusion::index(window));
      },
      testing::nasty_spheres(), rc::gen::inRange<std::uint32_t>(1, 4), rc::gen::arbitrary<bool>());
}

std::vector<Sphere> random_ball(std::uint32_t n, float size, float radius) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> at(-size, size), r(radius / 2, radius);
  std::vector<Sphere> spheres(n);
  for (auto& s : spheres) s = {at(random), at(random), at(random), r(random)};
  return spheres;
}

RC_GTEST_PROP(Grid, NearPairsAreThoseOfTheDefinition, ()) {
  const Chain chain = *nasty_chain();
  std::vector<Pair> found, right;
  near_pairs(chain, [&](const Pair& pair, bool collides, double m) {
    found.push_back(pair);
    const Sphere &a = chain[pair.i], &b = chain[pair.j];
    RC_ASSERT(collides == (gap_sign_by_integers(a, b) <= 0));
    RC_ASSERT(std::fabs(m - margin(a, b)) <= 0x1p-39 * m);
  });
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 1; j < chain.size(); ++j)
      if (!chain.neighbours(i, j) &&
          (gap_sign_by_integers(chain[i], chain[j]) <= 0 || margin(chain[i], chain[j]) < 1))
        right.push_back({i, j});
  std::ranges::sort(found);
  RC_ASSERT(found == right);
}

TEST(Grid, NearPairsEndAtAMarginOfOneExactly) {
  // Distance^2 = 2 (1 + 1)^2 but for the step in x, which is lost when binary64 subtracts it from 2.
  for (const float step : {0x1p-53f, 0.0f, -0x1p-53f}) {
    std::size_t found = 0;
    near_pairs(Chain({{step, 0, 0, 1}, {100, 0, 0, 0}, {2, 2, 0, 1}}),
               [&](const Pair&, bool, double) { ++found; });
    EXPECT_EQ(found, step > 0 ? 1u : 0u) << step;
  }
}

RC_GTEST_PROP(Grid, EqualsAllPairsEqualsTheDefinition, ()) {
  const Chain chain = *nasty_chain();
  const AllPairs right = by_definition(chain), fast = all_pairs(chain);
  RC_TAG(right.answer.pair_count > 0 ? "pairs" : "no pairs");
  RC_ASSERT(fast.answer == right.answer);
  RC_ASSERT(by_grid(chain) == right.answer);
  if (std::isinf(right.tightest.margin))
    RC_ASSERT(std::isinf(fast.tightest.margin));
  else
    RC_ASSERT(std::fabs(fast.tightest.margin - right.tightest.margin) <= 0x1p-39 * right.tightest.margin);
}

TEST(Grid, EqualsAllPairsOnManySpheres) {
  for (const float radius : {0.5f, 2.0f, 20.0f}) {
    const Chain chain(random_ball(5000, 50, radius));
    const Answer grid = by_grid(chain);
    EXPECT_GT(grid.pair_count, 0u);
    EXPECT_EQ(grid, all_pairs(chain).answer);
  }
}

TEST(Grid, MixedScales) {
  auto spheres = random_ball(2000, 1e30f, 1e29f);
  for (const auto& more : {random_ball(1000, 1, 0.1f), random_ball(500, 1e-42f, 1e-43f)})
    spheres.insert(spheres.end(), more.begin(), more.end());
  for (int k = 0; k < 3; ++k) spheres.push_back({1e30f, 1e30f, 0, 0});
  const Chain chain(spheres);
  EXPECT_EQ(by_grid(chain), all_pairs(chain).answer);
}

TEST(Grid, CellsThatRoundingAbsorbs) {
  // Cell 2^-10 at 2^60: the index is 2^70, next to which +-1 does not exist.
  std::vector<Sphere> spheres;
  for (int k = 0; k < 40; ++k)
    spheres.push_back({0x1p60f, testing::nudged(0x1p60f, k % 3), -0x1p60f, 0x1p-11f});
  const Answer grid = by_grid(Chain(spheres));
  EXPECT_GT(grid.pair_count, 0u);
  EXPECT_EQ(grid, all_pairs(Chain(spheres)).answer);
}

TEST(Reference, FindsPairsBelowAndAboveTheSwitch) {
  for (const std::uint32_t n : {0u, 1u, 2u, 4000u, 4001u}) {
    std::vector<Sphere> rod;
    for (std::uint32_t i = 0; i < n; ++i) rod.push_back({static_cast<float>(i), 0, 0, 1});
    const Answer answer = find(Chain(rod));  // i touches i + 2 and no one further
    EXPECT_EQ(answer.pair_count, n < 3 ? 0 : n - 2);
    EXPECT_EQ(answer.pairs.size(), answer.pair_count);
    EXPECT_EQ(answer.count.size(), n);
  }
}

TEST(Reference, LimitIsAnErrorWithTheTrueNumberAndCountsGoOn) {
  const Chain chain(std::vector<Sphere>(100, Sphere{0, 0, 0, 1}));
  for (const auto search :
       {+[](const Chain&c, const Request&r) { return all_pairs(c, r).answer; }, &by_grid}) {
    try {
      search(chain, {Request::Want::pairs, 10});
      ADD_FAILURE() << "no error past the limit";
    } catch (const PairLimitExceeded& error) {
      EXPECT_EQ(error.found(), 100u * 99 / 2 - 99);
    }
    const Answer counts = search(chain, {Request::Want::counts, 10});
    EXPECT_EQ(counts.pair_count, 100u * 99 / 2 - 99);
    EXPECT_EQ(counts.count[0], 98u);
    EXPECT_TRUE(counts.pairs.empty());
    EXPECT_FALSE(counts.has_pairs);
  }
}

/// The first of those that are as tight, and a touch that binary64 takes for a gap, after a gap that is less.
TEST(AllPairs, TightestIsTheFirstAndExact) {
  for (const float x : {2.001f, 2.5f}) {
    const Chain same({{0, 0, 0, 1}, {9, 0, 0, 1}, {x, 0, 0, 1}, {0, 9, 0, 1}, {x, 9, 0, 1}},
                     {{0, 1, 2, 3, 4, 5}, {}});
    EXPECT_EQ(all_pairs(same).tightest.pair, (Pair{0, 2})) << x;
  }
  std::size_t uncertain = 0;
  for (int k = 25; k < 48; ++k)
    for (const float odd : {1.f, 3.f, 5.f, 7.f, 11.f}) {
      const float e = std::ldexp(odd, -k);  // 3, 4, 5 times 1 + e
      const Sphere a{3, 4, 500, 5}, b{-3 * e, -4 * e, 500, 5 * e};
      const Chain chain({{0, 0, 0, 1}, {2, 0x1p-27f, 0, 1}, a, b}, {{0, 1, 2, 3, 4}, {}});
      uncertain += GapEstimate::of(a, b).gap != 0;
      EXPECT_EQ(all_pairs(chain).tightest.margin, 0) << k << ' ' << odd;
      EXPECT_EQ(all_pairs(chain).tightest.pair, (Pair{2, 3})) << k << ' ' << odd;
    }
  EXPECT_GT(uncertain, 0u);
}

TEST(AllPairs, TightestAndMargins) {
  const Chain chain({{0, 0, 0, 1}, {9, 0, 0, 1}, {2.5f, 0, 0, 1}, {4.25f, 0, 0, 1}}, {}, Exclusion::index(1));
  const AllPairs found = all_pairs(chain);
  EXPECT_EQ(found.tightest.pair, (Pair{0, 2}));
  EXPECT_EQ(found.tightest.margin, (6.25 - 4) / 4);
  const std::vector<Pair> asked{{0, 2}, {0, 1}};
  EXPECT_EQ(margins(chain, asked), (std::vector<double>{0.5625, (81.0 - 4) / 4}));
}

}  // namespace
}  // namespace catena::reference
