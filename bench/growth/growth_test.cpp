#include "catena/bench/growth/growth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "catena/core/error.h"

namespace catena::bench {
namespace {

Growth measured(const std::string& scene, const std::string& variant, std::uint32_t most) {
  return measure_growth(scene, StrategyRegistry::instance().describe(variant), most);
}

TEST(Growth, OfAPowerIsItsExponent) {
  Growth growth{"made", "up", {}};
  for (const std::uint32_t n : {1000u, 4000u, 16000u, 64000u})
    growth.points.push_back({n, static_cast<std::uint64_t>(std::pow(n, 1.5))});
  EXPECT_NEAR(growth.law().exponent, 1.5, 1e-4);
  EXPECT_NEAR(growth.law().low, 1.5, 1e-3);
  EXPECT_FALSE(growth.within_four_thirds());
  growth.points[2].node_pairs *= 3;
  EXPECT_LT(growth.law().low, 1.0) << "what lies off the line widens the interval";
}

/// Three points, worked out by hand: logarithms 0, 1, 2 against 0, 2, 2 give slope 1 and rest 2/3.
TEST(Growth, HasStudentsInterval) {
  const double e = std::exp(1.0);
  Growth growth{"made", "up", {}};
  const auto scaled = [&](double x) { return static_cast<std::uint64_t>(std::round(1e12 * std::exp(x))); };
  growth.points = {{1000, scaled(0)},
                   {static_cast<std::uint32_t>(std::round(1000 * e)), scaled(2)},
                   {static_cast<std::uint32_t>(std::round(1000 * e * e)), scaled(2)}};
  EXPECT_NEAR(growth.law().exponent, 1, 1e-3);
  EXPECT_NEAR(growth.law().high - growth.law().exponent, 12.706 * std::sqrt(2.0 / 3 / 2), 0.01);
}

TEST(Growth, OfAllPairsIsTheSquare) {
  const Growth growth = measured("path1", "CPU1", 10'000);
  ASSERT_EQ(growth.points.size(), 3u);
  EXPECT_EQ(growth.points.front().n, 1000u);
  EXPECT_EQ(growth.points.front().node_pairs, 999u * 998 / 2);
  EXPECT_NEAR(growth.law().exponent, 2, 0.01);
}

TEST(Growth, OfANecklaceIsWithinFourThirds) {
  for (const char* scene : {"yarn", "path1", "lattice"})
    for (const char* variant : {"Necklace", "Necklace(balls=nested)"})
      EXPECT_TRUE(measured(scene, variant, 32'000).within_four_thirds()) << scene << ' ' << variant;
}

TEST(GrowthLong, OfANecklaceIsWithinFourThirdsToTenMillion) {
  for (const char* scene : {"yarn", "path1", "lattice"})
    for (const char* variant : {"Necklace", "Necklace(balls=nested)"})
      EXPECT_TRUE(measured(scene, variant, 10'000'000).within_four_thirds()) << scene << ' ' << variant;
}

TEST(Growth, RefusesAVariantThatCountsNothing) {
  EXPECT_THROW(measured("yarn", "nanoflann", 10'000), Error);
  EXPECT_THROW(Growth{}.law(), std::logic_error);
}

}  // namespace
}  // namespace catena::bench
