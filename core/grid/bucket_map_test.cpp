#include "catena/core/grid/bucket_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

CentreBox cube(float side) { return {{0, 0, 0}, {side, side, side}}; }

TEST(BucketMap, LeadsDifferentStepsToDifferentBuckets) {
  for (std::uint32_t count = 0; count < 3000; ++count) {
    const BucketMap wrapped = map_buckets(1, cube(1e6f), count);
    ASSERT_TRUE(wrapped.wraps);
    ASSERT_TRUE(different_steps(wrapped)) << count;
  }
  for (const std::uint32_t count : {10000u, 99991u, 150000u, 1000000u, 10000000u, 2000000000u})
    EXPECT_TRUE(different_steps(map_buckets(1, cube(1e6f), count))) << count;
  for (const float x : {0.f, 3.f, 30.f})
    for (const float y : {0.f, 3.f, 30.f})
      for (const float z : {0.f, 3.f, 30.f}) {
        const BucketMap rows = map_buckets(1, {{-1, -1, -1}, {x, y, z}}, 5000);
        EXPECT_FALSE(rows.wraps);
        EXPECT_TRUE(different_steps(rows)) << x << ' ' << y << ' ' << z;
      }
}

/// As properties/proofs/grid_cells.g has it, for radii whose reciprocals are rounded up and down, everywhere
/// below far_cell.
TEST(BucketMap, HasCellsThatDifferByOneAtMostOfWhatIsInReach) {
  std::mt19937 random(1);
  const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  std::uint32_t tried = 0;
  for (int k = 0; k < 20000; ++k) {
    const float r = std::ldexp(1 + unit(), static_cast<int>(random() % 20) - 10);
    const double cells = map_buckets(r, cube(1e6f), 1000).cells_per_unit;
    EXPECT_LE(2.0 * r * cells, 1 - BucketMap::cell_slack / 2);
    EXPECT_GT(2.0 * r * cells, 0.999) << "cells no larger than they must be";
    const float x = (unit() - 0.5f) * static_cast<float>(BucketMap::far_cell / cells), y = x + 2 * r;
    if (double{y} - x > 2.0 * r || std::abs(x * cells) >= BucketMap::far_cell) continue;
    EXPECT_LE(std::floor(y * cells) - std::floor(x * cells), 1) << r << ' ' << x;
    EXPECT_LE(y * cells - x * cells, 1) << r << ' ' << x;
    ++tried;
  }
  EXPECT_GT(tried, 5000u);
}

TEST(BucketMap, TellsEqualSteps) {
  BucketMap map = map_buckets(1, cube(1e6f), 1000);
  map.layer = 2 * map.row;  // one layer on is one row on, and another one
  EXPECT_FALSE(different_steps(map));
}

TEST(BucketMap, HasAboutTwoBucketsASphereAtMost) {
  for (const std::uint32_t count : {0u, 1u, 1000u, 150000u, 10000000u})
    for (const float side : {1.f, 20.f, 30.f, 40.f, 100.f, 150.f, 1e4f, 1e30f}) {
      const BucketMap map = map_buckets(1, cube(side), count);
      EXPECT_LE(map.buckets, std::max<std::uint64_t>(2 * std::uint64_t{count}, 512) + 300)
          << count << ' ' << side;
      EXPECT_LE(map.buckets, BucketMap::most_buckets);
    }
}

/// How many of 20,000 cells, `step` apart in lines, planes or space, meet in one bucket at most.
std::uint32_t most_in_one(const std::vector<std::array<double, 3>>& cells) {
  const BucketMap map = map_buckets(1, cube(1e6f), static_cast<std::uint32_t>(cells.size()));
  std::vector<std::uint32_t> in(map.buckets, 0);
  for (const auto& [x, y, z] : cells) {
    const double on = x + map.row * y + map.layer * z;
    ++in[static_cast<std::size_t>(on - std::floor(on / map.buckets) * map.buckets)];
  }
  return *std::ranges::max_element(in);
}

TEST(BucketMap, SpreadsLinesPlanesAndSpace) {
  for (const double step : {1.0, 2.0, 3.0, 16.0, 64.0, 100.0, 1024.0})
    for (int directions = 1; directions < 8; ++directions) {
      std::vector<std::array<double, 3>> cells;
      const int axes = (directions & 1) + (directions >> 1 & 1) + (directions >> 2);
      const int side = static_cast<int>(std::lround(std::pow(20000.0, 1.0 / axes)));
      const auto sides = [&](int axis) { return directions >> axis & 1 ? side : 1; };
      for (int x = 0; x < sides(0); ++x)
        for (int y = 0; y < sides(1); ++y)
          for (int z = 0; z < sides(2); ++z) cells.push_back({step * x, step * y, step * z});
      EXPECT_LE(most_in_one(cells), 4u) << "step " << step << " along axes " << directions;
    }
}

/// Numbers of cells that are a multiple of a number of buckets whose reciprocal is rounded down, so that the
/// quotient may come out one too small: what lies there still meets what lies beside it.
TEST(BucketMap, BringsEveryMultipleOfTheBucketsIntoRange) {
  constexpr std::uint32_t multiples = 600;
  const float far = 2e7f;
  for (std::uint32_t alone = 0, tried = 0; alone < 4000 && tried < 8; alone += 7) {
    const std::uint32_t n = 2 * multiples + alone;
    const BucketMap map = map_buckets(1, {{0, 0, 0}, {far, far, far}}, n);
    ASSERT_TRUE(map.wraps);
    if (!(map.buckets * (1.0 / map.buckets) < 1)) continue;
    ++tried;
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 1; k <= multiples; ++k) {
      const double edge = static_cast<double>(k) * map.buckets / map.cells_per_unit;
      for (const double at : {0.5, -0.25})  // the cell of that number, and the one before
        spheres.push_back({static_cast<float>(edge + at), 0, 0, 1});
    }
    for (std::uint32_t k = 0; k + 1 < alone; ++k)
      spheres.push_back({0, 10.0f * static_cast<float>(k + 1), 0, 1});
    if (alone > 0) spheres.push_back({far, far, far, 1});
    const auto grid = StrategyRegistry::instance().make("Grid");
    Collisions found;
    const Chain chain(spheres, {{0, n}, {0}}, Exclusion::arc(1e-6));  // neighbours are pairs, too
    grid->build(chain);
    grid->find(chain, {}, found);
    EXPECT_EQ(found.pair_count, multiples) << map.buckets;
  }
}

}  // namespace
}  // namespace catena
