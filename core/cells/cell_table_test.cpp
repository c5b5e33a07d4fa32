#include "catena/core/cells/cell_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "catena/core/cells/octave.h"

namespace catena {
namespace {

/// The buckets of the 27 cells around one, by their numbers and by steps from its bucket.
void expect_27_buckets(const CellTable& table, double x, double y, double z, std::uint32_t level) {
  std::set<std::uint32_t> buckets;
  const std::uint32_t own = table.bucket(x, y, z, level);
  for (int k = 0; k < 27; ++k) {
    const std::uint32_t to = table.bucket(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1, level);
    const std::uint32_t row = table.on(own, table.step[k / 3]);
    EXPECT_EQ(to, k % 3 == 0 ? table.before(row) : k % 3 == 1 ? row : table.on(row, 1));
    EXPECT_LT(to, table.buckets);
    buckets.insert(to);
  }
  EXPECT_EQ(buckets.size(), 27u);
}

TEST(CellTable, HasAnotherBucketForEachOf27Cells) {
  for (const std::uint32_t count : {0u, 1u, 300u, 1u << 12, 1u << 17, 3000000u, 1u << 26})
    for (const double side : {0.0, 1.0, 7.5, 15.0, 150.0, 1e6}) {
      const CellTable table = CellTable::of(count).compact(side, side < 100);
      for (const double at : {0.0, -1.0, 12345.0, -33554431.0, 33554430.0})
        for (const std::uint32_t level : {0u, 1u, 31u, 287u}) {
          expect_27_buckets(table, at, -at / 3, at / 7, level);
          expect_27_buckets(table, -1, at, 2, level);
        }
    }
}

TEST(CellTable, BringsEveryWholeRoundBackToTheFirstBucket) {
  for (std::uint32_t size = 12; size <= 26; ++size) {
    const CellTable table = CellTable::of(1u << size);
    for (double round = -300; round < 300 && std::abs(round) * table.buckets < 0x1p50; ++round) {
      EXPECT_EQ(table.bucket(round * table.buckets, 0, 0, 0), 0u);
      EXPECT_EQ(table.bucket(round * table.buckets - 1, 0, 0, 0), table.buckets - 1);
    }
  }
}

TEST(CellTable, LaysACompactBoxOutWithoutSharedBuckets) {
  for (const bool one_level : {false, true}) {
    const CellTable table = CellTable::of(1 << 15).compact(20, one_level);
    EXPECT_LE(table.buckets, one_level ? 13000u : 1u << 16);
    std::set<std::uint32_t> buckets;
    for (int x = 0; x < 20; ++x)
      for (int y = 0; y < 20; ++y)
        for (int z = 0; z < 20; ++z) buckets.insert(table.bucket(x - 10, y - 10, z - 10, 0));
    EXPECT_EQ(buckets.size(), 8000u);
  }
}

TEST(AxisCell, NumbersEqualFarCoordinatesAlikeAndReachesNothingElse) {
  const AxisCell far = AxisCell::of(1e30f, 1), same = AxisCell::of(1e30f, 1);
  EXPECT_EQ(far.cell, same.cell);
  EXPECT_EQ(far.below, 0);
  EXPECT_EQ(far.above, 0);
  const AxisCell near = AxisCell::of(-2.25f, 1);
  EXPECT_EQ(near.cell, -3);
  EXPECT_EQ(near.below, 0.75f);
  EXPECT_EQ(near.above, 0.25f);
}

TEST(Octaves, HoldNoRadiusAboveTheirBound) {
  for (const float greatest : {1.0f, 1.5f, 3e38f, 1e-40f, 0x1p-149f}) {
    const Octaves octaves{greatest, false, false};
    for (float r = greatest; r > 0; r *= 0.4999f) {
      const std::uint32_t k = octaves.of(r);
      ASSERT_LT(k, Octaves::count);
      EXPECT_LE(double{r} * Octaves::cells_of(k), double{greatest}) << r;
      EXPECT_GT(2 * double{r} * Octaves::cells_of(k), double{greatest}) << r;
    }
    EXPECT_EQ(octaves.of(0), Octaves::count - 1);
    EXPECT_EQ(octaves.of(-0.0f), Octaves::count - 1);
  }
}

}  // namespace
}  // namespace catena
