#include "catena/bench/growth/growth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catena/bench/counts/count_work.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"

namespace catena::bench {
namespace {

Growth measured(const std::string& scene, const std::string& variant, std::uint32_t most) {
  return measure_growth(scene, StrategyRegistry::instance().describe(variant), most);
}

TEST(Growth, OfAPowerIsItsExponent) {
  Growth growth{"made", "up", {}};
  for (const std::uint32_t n : {1000u, 4000u, 16000u, 64000u, 256000u})
    growth.points.push_back({n, static_cast<std::uint64_t>(std::pow(n, 1.5))});
  EXPECT_NEAR(growth.law().exponent, 1.5, 1e-3);
  EXPECT_NEAR(growth.law().low, 1.5, 1e-2);
  EXPECT_NEAR(growth.plain_power().exponent, 1.5, 1e-3);
  EXPECT_FALSE(growth.within_four_thirds());
  growth.points[2].node_pairs *= 3;
  EXPECT_LT(growth.law().low, 1.0) << "what lies off the line widens the interval";
}

/// The interval of four points and two columns, by the textbook: Student's t of two degrees of freedom
/// is 4.303.
TEST(Growth, IntervalIsThatOfStudentsT) {
  Growth growth{"made", "up", {}};
  for (const auto& [n, pairs] :
       {std::pair{1000u, 1000u}, {10'000u, 12'000u}, {100'000u, 90'000u}, {1'000'000u, 1'100'000u}})
    growth.points.push_back({n, pairs});
  double x = 0, y = 0, xx = 0, xy = 0, rest = 0;
  for (const auto& p : growth.points) x += std::log(p.n) / 4, y += std::log(p.node_pairs) / 4;
  for (const auto& p : growth.points)
    xx += std::pow(std::log(p.n) - x, 2), xy += (std::log(p.n) - x) * (std::log(p.node_pairs) - y);
  for (const auto& p : growth.points)
    rest += std::pow(std::log(p.node_pairs) - y - xy / xx * (std::log(p.n) - x), 2);
  const double half = 4.303 * std::sqrt(rest / 2 / xx);
  EXPECT_NEAR(growth.plain_power().exponent, xy / xx, 1e-9);
  EXPECT_NEAR(growth.plain_power().high - growth.plain_power().low, 2 * half, 1e-9);
}

TEST(Growth, TellsABodyFromItsSurface) {
  Growth growth{"made", "up", {}};
  for (const std::uint32_t n : {1000u, 4000u, 16000u, 64000u, 256000u}) {
    const double surface = 0.5 / std::cbrt(n);
    growth.points.push_back({n, static_cast<std::uint64_t>(100 * std::pow(n, 4.0 / 3) * std::exp(-surface))});
  }
  EXPECT_NEAR(growth.law().exponent, 4.0 / 3, 1e-4);
  EXPECT_TRUE(growth.within_four_thirds());
}

TEST(Growth, CountsEveryPairOfAllPairs) {
  const Growth growth = measured("path1", "CPU1", 1000);
  ASSERT_EQ(growth.points.size(), 1u);
  EXPECT_EQ(growth.points.front().n, 1000u);
  EXPECT_EQ(growth.points.front().node_pairs, 999u * 998 / 2);
  const auto tree = StrategyRegistry::instance().describe("aCPU2+CPU2");
  const auto work = count_work(tree, open_input("path1:n=1000").animation->frame(0));
  EXPECT_GT(work->node_visits, 0u);
  EXPECT_EQ(measured("path1", "aCPU2+CPU2", 1000).points.front().node_pairs,
            work->pair_tests + work->node_visits);
}

TEST(Growth, OfANecklaceIsWithinFourThirds) {
  for (const char* scene : {"yarn", "path1", "lattice"})
    for (const char* variant : {"Necklace", "Necklace(balls=nested)"})
      EXPECT_TRUE(measured(scene, variant, 32'000).within_four_thirds()) << scene << ' ' << variant;
}

TEST(GrowthLong, OfANecklaceIsWithinFourThirdsToAMillion) {
  for (const char* scene : {"yarn", "path1", "lattice"})
    for (const char* variant : {"Necklace", "Necklace(balls=nested)"})
      EXPECT_TRUE(measured(scene, variant, 1'000'000).within_four_thirds()) << scene << ' ' << variant;
}

TEST(Growth, RefusesAVariantThatCountsNothing) {
  EXPECT_THROW(measured("yarn", "nanoflann", 10'000), Error);
  EXPECT_THROW(Growth{}.law(), std::logic_error);
  Growth three{"made", "up", {{1000, 1000}, {4000, 4000}, {16'000, 16'000}}};
  EXPECT_THROW(three.plain_power(), std::logic_error) << "too few";
  three.points.push_back({64'000, 0});
  EXPECT_THROW(three.plain_power(), std::logic_error) << "nothing was counted";
  three.points.back() = {0, 64'000};
  EXPECT_THROW(three.plain_power(), std::logic_error);
}

}  // namespace
}  // namespace catena::bench
