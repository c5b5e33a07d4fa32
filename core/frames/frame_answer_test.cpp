#include "catena/core/frames/frame_answer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "catena/core/error.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {
namespace {

/// What an answer should be, made anew each time.
struct Plain {
  std::uint32_t n;
  std::vector<Pair> pairs;

  std::vector<std::uint32_t> counts() const {
    std::vector<std::uint32_t> counts(n);
    for (const Pair& p : pairs) ++counts[p.i], ++counts[p.j];
    return counts;
  }
  Collisions all() const { return {!pairs.empty(), pairs.size(), counts(), pairs}; }
};

Plain some_pairs(std::uint32_t n, std::size_t pairs, std::mt19937& random) {
  Plain plain{n, {}};
  while (plain.pairs.size() < pairs) {
    const std::uint32_t i = random() % n, j = random() % n;
    if (i < j && std::ranges::find(plain.pairs, Pair{i, j}) == plain.pairs.end())
      plain.pairs.push_back({i, j});
  }
  return plain;
}

void expect_same(FrameAnswer& answer, const Plain& plain) {
  Collisions reported{plain.pairs.empty(), 7, std::vector<std::uint32_t>(plain.n, 3), {{1, 2}}};  // another's
  answer.report(plain.n, {}, reported);
  Collisions standing = answer.standing(plain.n, {});
  std::vector<Pair> right = plain.pairs;
  properties::sort(right);
  for (Collisions* result : {&reported, &standing}) {
    properties::sort(result->pairs);
    EXPECT_EQ(result->pairs, right);
    EXPECT_EQ(result->count, plain.counts());
    EXPECT_EQ(result->pair_count, right.size());
    EXPECT_EQ(result->found, !right.empty());
  }
}

/// Many pairs, whose counts are carried on, and few, whose counts are made anew; asked for in between or not.
TEST(FrameAnswer, IsCarriedOnByShiftsAndExchanges) {
  std::mt19937 random(3);
  for (const std::size_t pairs : {0, 5, 300})
    for (const bool asked : {false, true}) {
      Plain plain = some_pairs(97, pairs, random);
      FrameAnswer answer;
      answer.copy(plain.all());
      if (asked) expect_same(answer, plain);
      for (const int s : {5, -3, 60, -90, 1}) {
        std::erase_if(plain.pairs, [&](Pair& p) {
          const int i = static_cast<int>(p.i) - s, j = static_cast<int>(p.j) - s;
          p = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)};
          return i < 0 || j >= 97;
        });
        answer.shift(97, s);
        if (asked) expect_same(answer, plain);

        const std::vector<Pair> there(answer.pairs().begin(), answer.pairs().end());
        std::vector<std::uint32_t> places;
        for (std::uint32_t k = 0; k < there.size(); ++k)
          if (random() % 3 == 0) places.push_back(k);
        for (const std::uint32_t k : places) std::erase(plain.pairs, there[k]);
        std::vector<Pair> fresh;
        for (const Pair& p : some_pairs(97, pairs / 2, random).pairs)
          if (std::ranges::find(plain.pairs, p) == plain.pairs.end()) fresh.push_back(p);
        plain.pairs.insert(plain.pairs.end(), fresh.begin(), fresh.end());
        answer.exchange(places, fresh);
        if (asked) expect_same(answer, plain);
      }
      expect_same(answer, plain);
    }
}

TEST(FrameAnswer, HeedsALimitForWhoAsksForPairs) {
  std::mt19937 random(4);
  const Plain plain = some_pairs(50, 20, random);
  FrameAnswer answer;
  answer.copy(plain.all());
  Collisions result;
  for (const std::uint64_t limit : {0u, 19u}) {
    EXPECT_THROW(answer.standing(50, {.pair_limit = limit}), PairLimitExceeded) << limit;
    EXPECT_THROW(answer.report(50, {.pair_limit = limit}, result), PairLimitExceeded) << limit;
  }
  EXPECT_EQ(answer.standing(50, {.pair_limit = 20}).pairs.size(), 20u) << "exactly met";
  answer.report(50, {.pair_limit = 20}, result);
  EXPECT_EQ(result.pairs.size(), 20u);
  EXPECT_EQ(answer.standing(50, {.want = Request::Want::counts, .pair_limit = 19}).count, plain.counts());
  EXPECT_TRUE(answer.standing(50, {.want = Request::Want::any}).found);
}

/// Whoever asks, and whatever the result held before.
TEST(FrameAnswer, StatesTheTrueNumberPastALimitAndLeavesNoPairsToWhoWantsNone) {
  std::mt19937 random(5);
  const Plain plain = some_pairs(50, 40, random);
  FrameAnswer answer;
  answer.copy(plain.all());
  Collisions result;
  const auto found = [](const auto& ask) -> std::uint64_t {
    try {
      ask();
    } catch (const PairLimitExceeded& error) {
      return error.found();
    }
    return 0;
  };
  EXPECT_EQ(found([&] { answer.standing(50, {.pair_limit = 7}); }), 40u);
  EXPECT_EQ(found([&] { answer.report(50, {.pair_limit = 7}, result); }), 40u);
  for (const auto want : {Request::Want::counts, Request::Want::any})
    for (const SphereRange queries : {SphereRange{}, SphereRange{3, 40}}) {
      result = {false, 7, std::vector<std::uint32_t>(9, 3), {{1, 2}, {3, 4}}};
      answer.report(50, {.want = want, .queries = queries}, result);
      EXPECT_TRUE(result.pairs.empty());
      EXPECT_TRUE(result.found);
    }
}

TEST(FrameAnswer, ReportsOfSomeSpheresAloneWhatIsTheirs) {
  std::mt19937 random(6);
  const Plain plain = some_pairs(50, 40, random);
  FrameAnswer answer;
  answer.copy(plain.all());
  const SphereRange queries{10, 30};
  Collisions result;
  answer.report(50, {.queries = queries}, result);
  std::vector<Pair> right = plain.pairs;
  std::erase_if(right, [&](const Pair& p) { return !queries.contains(p.i); });
  properties::sort(right), properties::sort(result.pairs);
  EXPECT_EQ(result.pairs, right);
  EXPECT_EQ(result.pair_count, right.size());
  for (std::uint32_t i = 0; i < 50; ++i)
    EXPECT_EQ(result.count[i], queries.contains(i) ? plain.counts()[i] : 0) << i;
}

}  // namespace
}  // namespace catena
