#include "catena/bench/timing/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

namespace catena::bench {
namespace {

constexpr double ever = 1e9;  // seconds

/// What was asked, a list of runs for each round.
struct Asked {
  std::vector<std::vector<std::size_t>> rounds;
  void operator()(const Turn& turn) {
    if (turn.place == 0) rounds.emplace_back();
    EXPECT_EQ(turn.round + 1, rounds.size());
    EXPECT_EQ(turn.place, rounds.back().size());
    rounds.back().push_back(turn.run);
  }
};

TEST(Sampling, ARoundHasEveryRunOnceInAFreshOrderThatKeepsUnitsTogether) {
  const Groups groups{{{0, 1}, {2, 3}, {4}}, {{5}, {6, 7}}, {{8, 9}}};
  Asked asked;
  const auto samples =
      sample_in_rounds(groups, {.seconds = ever, .share = 0, .most_samples = 20}, [&](const Turn& turn) {
        EXPECT_EQ(turn.places, 10u);
        asked(turn);
        return static_cast<double>(turn.run);
      });
  EXPECT_EQ(samples.rounds, 20u);
  std::set<std::vector<std::size_t>> orders;
  for (const auto& round : asked.rounds) {
    orders.insert(round);
    auto sorted = round;
    std::ranges::sort(sorted);
    EXPECT_EQ(sorted, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
    const auto place = [&](std::size_t run) { return std::ranges::find(round, run) - round.begin(); };
    for (const std::size_t first : {0, 2, 6, 8}) EXPECT_EQ(place(first + 1), place(first) + 1);
    const auto [low, high] = std::minmax({place(0), place(2), place(4)});
    EXPECT_LE(high - low, 4) << "a group keeps together";
  }
  EXPECT_GE(orders.size(), 12u) << "of 72";
  for (std::size_t run = 0; run < 10; ++run)
    EXPECT_EQ(samples.ms[run], std::vector<double>(20, static_cast<double>(run)));
}

TEST(Sampling, ASeedGivesTheSameOrderAgain) {
  const auto order = [](std::uint64_t seed) {
    std::vector<std::size_t> runs;
    sample_in_rounds({{{0}}, {{1}}, {{2}}, {{3}}, {{4}}},
                     {.seconds = ever, .share = 0, .most_samples = 3, .seed = seed}, [&](const Turn& turn) {
                       runs.push_back(turn.run);
                       return 1.0;
                     });
    return runs;
  };
  EXPECT_EQ(order(1), order(1));
  EXPECT_NE(order(1), order(2));
}

/// Each interruption would else begin with the same order again.
TEST(Sampling, GoesOnInAnotherOrderThanItBegan) {
  std::set<std::vector<std::size_t>> orders;
  for (std::size_t rounds = 0; rounds < 10; ++rounds) {
    std::vector<std::size_t> first;
    sample_in_rounds({{{0}}, {{1}}, {{2}}, {{3}}, {{4}}}, {.seconds = ever, .share = 0, .most_samples = 1},
                     [&](const Turn& turn) {
                       EXPECT_EQ(turn.round, rounds);
                       first.push_back(turn.run);
                       return 1.0;
                     },
                     {{}, rounds, {}});
    orders.insert(first);
  }
  EXPECT_GE(orders.size(), 6u) << "of 120";
}

TEST(Sampling, ARunIsDoneWhenItsIntervalIsNarrowOrItFails) {
  Asked asked;
  const auto samples =
      sample_in_rounds({{{0}, {1}, {2}}}, {.seconds = ever, .share = 0.05, .most_samples = 9},
                       [&](const Turn& turn) -> std::optional<double> {
                         asked(turn);
                         if (turn.run == 2 && turn.round == 1) return {};
                         return turn.run == 0 ? 1.0 : static_cast<double>(1 + turn.round);
                       });
  EXPECT_EQ(samples.ms[0].size(), 6u) << "six samples are the fewest that bound a median";
  EXPECT_EQ(samples.ms[1].size(), 9u);
  EXPECT_EQ(samples.ms[2].size(), 1u);
  EXPECT_EQ(asked.rounds.size(), 9u);
  EXPECT_EQ(asked.rounds[1].size(), 3u);
  EXPECT_EQ(asked.rounds[2].size(), 2u);
  EXPECT_EQ(asked.rounds[6].size(), 1u);
}

TEST(Sampling, WithoutTimeNothingIsAskedUnlessRoundsArePromised) {
  const Groups groups{{{0}, {1}}};
  const auto sizes = [&](const Stopping& stopping) {
    std::vector<std::size_t> counted;
    for (const auto& ms : sample_in_rounds(groups, stopping, [](const Turn&) { return 1.0; }).ms)
      counted.push_back(ms.size());
    return counted;
  };
  EXPECT_EQ(sizes({.seconds = 0}), (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(sizes({.seconds = 0, .share = 0, .least_rounds = 3}), (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(sizes({.seconds = 0, .share = 0, .most_samples = 2, .least_rounds = 3}),
            (std::vector<std::size_t>{2, 2}));
}

TEST(Sampling, ARoundThatHasBegunIsFinishedOnlyWhereItIsWanted) {
  for (const bool whole : {false, true}) {
    const auto samples = sample_in_rounds(
        {{{0}, {1}, {2}}}, {.seconds = 0.02, .share = 0, .least_rounds = 0, .whole_rounds = whole},
        [](const Turn&) {
          std::this_thread::sleep_for(std::chrono::milliseconds(30));
          return 30.0;
        });
    EXPECT_EQ(samples.rounds, 1u);
    EXPECT_EQ(samples.ms[0].size() + samples.ms[1].size() + samples.ms[2].size(), whole ? 3u : 1u);
  }
}

TEST(Sampling, InterleavedRunsHaveEquallyManySamplesAtLeastThree) {
  int calls = 0;
  const std::vector<std::function<double()>> runs{[&] { return ++calls, 1.0; }, [&] { return ++calls, 2.0; }};
  EXPECT_EQ(interleave(runs, 100, 0, 1), (std::vector<std::vector<double>>{{1, 1, 1}, {2, 2, 2}}));
  EXPECT_EQ(calls, 6);
  EXPECT_EQ(interleave(runs, 1, ever, 1), (std::vector<std::vector<double>>{{1}, {2}}));
  EXPECT_TRUE(interleave({}, 5, ever, 1).empty());
  EXPECT_EQ(interleave(runs, 0, ever, 1), std::vector<std::vector<double>>(2));
}

}  // namespace
}  // namespace catena::bench
