#include "catena/bench/timing/median_interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace catena::bench {
namespace {

MedianInterval of_first(int n) {
  std::vector<double> samples(static_cast<std::size_t>(n));
  std::iota(samples.rbegin(), samples.rend(), 1.0);
  return median_interval(samples);
}

TEST(MedianInterval, TakesTheTabulatedOrderStatistics) {
  EXPECT_FALSE(of_first(5).bounded);
  EXPECT_TRUE(std::isinf(of_first(5).relative_width()));
  const std::vector<double> nothing(20, 0.0);
  EXPECT_TRUE(std::isinf(median_interval(nothing).relative_width())) << "of times that no clock saw";
  const struct {
    int n;
    double lower, upper;
  } table[]{{6, 1, 6}, {9, 2, 8}, {20, 6, 15}, {50, 18, 33}, {100, 40, 61}};  // Conover 1999, two-sided 95 %
  for (const auto& row : table) {
    EXPECT_TRUE(of_first(row.n).bounded) << row.n;
    EXPECT_EQ(of_first(row.n).lower, row.lower) << row.n;
    EXPECT_EQ(of_first(row.n).upper, row.upper) << row.n;
  }
  EXPECT_EQ(of_first(2).median, 1.5);
  EXPECT_TRUE(of_first(20'000).bounded);
  EXPECT_THROW(median_interval({}), std::invalid_argument);
}

TEST(MedianInterval, CoversTheMedianAsOftenAsItSays) {
  std::mt19937_64 random(1);
  std::exponential_distribution<double> skewed;
  int covered = 0;
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> samples(15);
    for (double& s : samples) s = skewed(random);
    const auto interval = median_interval(samples);
    covered += interval.lower <= std::log(2.0) && std::log(2.0) <= interval.upper;
  }
  EXPECT_GE(covered, trials * 0.95);
  EXPECT_LE(covered, trials * 0.985);  // 0.965 for 15 samples
}

}  // namespace
}  // namespace catena::bench
