#include "catena/core/executor/pair_collector.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace catena {
namespace {

TEST(PairCollector, KeepsTheOrderOfLanes) {
  Collisions result;
  PairCollector collector(10, {}, result, 3);
  collector.lane(2).pair(5, 6);
  collector.lane(0).pair(1, 2);
  collector.lane(1).pair(3, 4);
  collector.lane(1).count(3, 7);
  collector.finish();
  EXPECT_EQ(result.pairs, (std::vector<Pair>{{1, 2}, {3, 4}, {5, 6}}));
  EXPECT_EQ(result.pair_count, 3u);
  EXPECT_EQ(result.count[3], 7u);
  EXPECT_TRUE(result.found);
}

TEST(PairCollector, HeedsWhatIsAskedOfSomeSpheresAlone) {
  Collisions result;
  PairCollector collector(10, {.queries = {3, 6}}, result, 1);
  for (std::uint32_t i = 0; i < 10; ++i) collector.lane(0).count(i, i + 1);
  collector.lane(0).pair(2, 5), collector.lane(0).pair(3, 9), collector.lane(0).pair(6, 7);
  collector.finish();
  EXPECT_EQ(result.pairs, (std::vector<Pair>{{3, 9}}));
  EXPECT_EQ(result.count, (std::vector<std::uint32_t>{0, 0, 0, 4, 5, 6, 0, 0, 0, 0}));
}

TEST(PairCollector, ExactlyTheLimitIsKeptAndOneMoreIsAnErrorWithTheTrueNumber) {
  for (std::uint64_t found : {100u, 101u, 20000u}) {
    Collisions result;
    PairCollector collector(2, {Request::Want::pairs, 100}, result, 2);
    for (std::uint64_t k = 0; k < found; ++k) collector.lane(k % 2).pair(0, 1);
    if (found <= 100) {
      collector.finish();
      EXPECT_EQ(result.pairs.size(), found);
      continue;
    }
    try {
      collector.finish();
      ADD_FAILURE() << "no error at " << found;
    } catch (const PairLimitExceeded& error) {
      EXPECT_EQ(error.found(), found);
      EXPECT_EQ(error.limit(), 100u);
      EXPECT_TRUE(result.pairs.empty());
    }
  }
}

TEST(PairCollector, MemoryForPairsIsBoundedByTheLimit) {
  Collisions result;
  PairCollector collector(2, {Request::Want::pairs, 1000}, result, 1);
  for (int k = 0; k < 1'000'000; ++k) collector.lane(0).pair(0, 1);
  EXPECT_LT(result.pairs.capacity(), 20'000u);
  EXPECT_THROW(collector.finish(), PairLimitExceeded);
}

TEST(PairCollector, CountsOnlyHasNoLimitAndNoPairs) {
  Collisions result;
  PairCollector collector(2, {Request::Want::counts, 5}, result, 1);
  for (int k = 0; k < 10; ++k) collector.lane(0).pair(0, 1);
  collector.finish();
  EXPECT_EQ(result.pair_count, 10u);
  EXPECT_TRUE(result.pairs.empty());
}

TEST(PairCollector, AnyIsSatisfiedByTheFirstPairOfAnyLane) {
  Collisions result;
  PairCollector collector(2, {Request::Want::any, 5}, result, 2);
  EXPECT_FALSE(collector.lane(0).satisfied());
  collector.lane(1).pair(0, 1);
  EXPECT_TRUE(collector.lane(1).satisfied());
  collector.finish();
  EXPECT_TRUE(result.found);
  EXPECT_TRUE(result.count.empty());
}

TEST(PairCollector, LanesCountTheSameSpheresTogether) {
  // More than a byte holds, by each of three lanes, at both ends of the array and in different pages.
  constexpr std::uint32_t n = 10'000, times = 700;
  Collisions result;
  PairCollector collector(n, {Request::Want::counts}, result, 3);
  for (unsigned lane = 0; lane < 3; ++lane) {
    for (std::uint32_t k = 0; k < times; ++k) collector.lane(lane).collide(0, n - 1);
    const std::vector<Pair> some{{0, 5000}, {5000, 6000}};
    collector.lane(lane).collide(some);
  }
  collector.finish();
  EXPECT_EQ(result.pair_count, 3 * (times + 2));
  EXPECT_EQ(result.count[0], 3 * (times + 1));
  EXPECT_EQ(result.count[5000], 6u);
  EXPECT_EQ(result.count[6000], 3u);
  EXPECT_EQ(result.count[n - 1], 3 * times);
  EXPECT_EQ(std::accumulate(result.count.begin(), result.count.end(), std::uint64_t{0}),
            2 * result.pair_count);
}

TEST(PairCollector, WhatAnUnfinishedSearchCountedIsForgotten) {
  constexpr std::uint32_t n = 5'000;
  const Team team(Parameters("test", {Team::threads_parameter()}, "threads=2"));
  if (team.size() == 1) GTEST_SKIP() << "one core: there is no team";
  std::vector<LaneCounts> counts;
  Collisions result;
  for (const bool finished : {true, false, true, false, false, true}) {
    PairCollector collector(n, {}, result, team, counts);
    for (std::uint32_t k = 0; k < 300; ++k) collector.lane(k % 2).collide(7, n - 1);
    if (!finished) continue;
    collector.finish();
    EXPECT_EQ(result.count[7], 300u);
    EXPECT_EQ(std::accumulate(result.count.begin(), result.count.end(), std::uint64_t{0}), 600u);
    EXPECT_EQ(result.pairs, std::vector<Pair>(300, Pair{7, n - 1}));
  }
}

TEST(PairCollector, ManyPairsAtOnceAreFilteredByTheQueries) {
  Collisions result;
  Request request;
  request.queries = {2, 4};
  PairCollector collector(6, request, result);
  const std::vector<Pair> pairs{{0, 2}, {2, 5}, {3, 4}, {4, 5}};
  collector.lane(0).collide(pairs);
  collector.finish();
  EXPECT_EQ(result.pairs, (std::vector<Pair>{{2, 5}, {3, 4}}));
  EXPECT_EQ(result.count, (std::vector<std::uint32_t>{0, 0, 2, 1, 0, 0}));
}

}  // namespace
}  // namespace catena
