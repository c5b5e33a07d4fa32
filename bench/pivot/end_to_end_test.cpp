#include "catena/bench/pivot/end_to_end.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace catena::bench {
namespace {

double square(const LatticePoint& p) { return std::pow(p.x, 2) + std::pow(p.y, 2) + std::pow(p.z, 2); }

/// The error of the mean of some runs is that by which they differ among themselves, over the root of their
/// number.
TEST(EndToEndError, IsThatOfTheMeanOfItsRuns) {
  constexpr int runs = 32, moves = 8, warm_up = 100;
  PivotWalk measured(64), walk(64);
  Random random(5), again(5);
  const EndToEnd seen = measure_end_to_end(measured, runs * moves, random, warm_up);
  for (int k = 0; k < warm_up; ++k) walk.attempt(random_pivot(64, again));
  std::vector<double> means;
  for (int run = 0; run < runs; ++run) {
    means.push_back(0);
    for (int k = 0; k < moves; ++k) {
      walk.attempt(random_pivot(64, again));
      means.back() += square(walk.end_to_end()) / moves;
    }
  }
  double mean = 0, squares = 0;
  for (const double of_run : means) mean += of_run / runs;
  for (const double of_run : means) squares += std::pow(of_run - mean, 2);
  EXPECT_EQ(seen.attempts, runs * moves);
  EXPECT_NEAR(seen.mean_square, mean, 1e-9 * mean);
  EXPECT_NEAR(seen.error, std::sqrt(squares / (runs - 1) / runs), 1e-9 * mean);
}

TEST(EndToEnd, MeasuresEveryAttemptThatRunsDoNotShareEvenly) {
  constexpr std::uint64_t attempts = 100;
  PivotWalk measured(64), walk(64);
  Random random(5), again(5);
  const EndToEnd seen = measure_end_to_end(measured, attempts, random, 0);
  double mean = 0, accepted = 0;
  for (std::uint64_t k = 0; k < attempts; ++k) {
    accepted += walk.attempt(random_pivot(64, again)) ? 1. / attempts : 0;
    mean += square(walk.end_to_end()) / attempts;
  }
  EXPECT_EQ(seen.attempts, attempts);
  EXPECT_NEAR(seen.acceptance, accepted, 1e-12);
  EXPECT_NEAR(seen.mean_square, mean, 1e-9 * mean);
}

/// Of attempts, whether or not they are accepted.
TEST(EndToEnd, TakesNoMoreTimeThanPasses) {
  constexpr std::uint64_t attempts = 20'000;
  PivotWalk walk(64);
  Random random(5);
  const double before = processor_us();
  const EndToEnd seen = measure_end_to_end(walk, attempts, random, 0);
  const double passed = processor_us() - before;
  EXPECT_LT(seen.acceptance, 0.9);
  EXPECT_LE(seen.us_per_attempt * attempts, passed * (1 + 1e-9));
  EXPECT_GE(seen.us_per_attempt * attempts, passed / 2);
}

}  // namespace
}  // namespace catena::bench
