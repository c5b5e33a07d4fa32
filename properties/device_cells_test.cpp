#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "catena/core/cells/sphere_cells.h"
#include "catena/properties/testing/answer_of.h"
#include "catena/properties/testing/no_device.h"

// So many spheres that kernels have more to do than a device has threads for at a time, or count further than
// 16 bits reach.
namespace catena::properties {
namespace {

class DeviceCells : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = no_device()) GTEST_SKIP() << *why;
  }
};

const Request counts{.want = Request::Want::counts};

/// Of so many a side, row by row. Those above and below, in front and behind touch; beside it are neighbours.
void expect_counts_of_lattice(std::uint32_t x_side, std::uint32_t y_side, std::uint32_t z_side,
                              const std::vector<const char*>& names) {
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> expected;
  const auto begin =
      static_cast<float>(x_side / 2);  // on both sides of the first bucket: the last ones hold some, too
  const auto beside = [](std::uint32_t k, std::uint32_t side) {
    return std::uint32_t{k > 0} + (k + 1 < side);
  };
  for (std::uint32_t z = 0; z < z_side; ++z)
    for (std::uint32_t y = 0; y < y_side; ++y)
      for (std::uint32_t x = 0; x < x_side; ++x) {
        spheres.push_back(
            {static_cast<float>(x) - begin, static_cast<float>(y), static_cast<float>(z), 0.55f});
        expected.push_back(beside(y, y_side) + beside(z, z_side));
      }
  const Chain chain(std::move(spheres));
  for (const char* name : names) {
    const Collisions found = answer_of(name, chain, counts);
    EXPECT_EQ(found.pair_count, std::uint64_t{x_side} * ((y_side - 1) * z_side + y_side * (z_side - 1)))
        << name;
    EXPECT_TRUE(found.count == expected) << name;
  }
}

/// So many spheres that a device's cells are sorted by bins which are begun some thousands at a time, and
/// which are more than those of fewer spheres may be.
TEST_F(DeviceCells, OfMoreBinsThanAreBegunAtATime) {
  expect_counts_of_lattice(290, 290, 290, {"DeviceGrid", "DeviceHybrid(crowd=0)"});  // 18 million cells
}

/// The last bins that are begun together are full: nothing but where the last one ends comes behind them.
TEST_F(DeviceCells, OfTheMostBins) {
  constexpr std::uint32_t side = 5793;
  static_assert(side * side > 1u << 25);  // the largest table, as a plane is not near a cube
  expect_counts_of_lattice(side, side, 1, {"DeviceGrid"});
}

/// 100 spheres in a row, and as many rows in a layer.
std::vector<Sphere> lattice_of_hundreds(int n, float radius) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < n; ++i)
    spheres.push_back({static_cast<float>(i % 100), static_cast<float>(i / 100 % 100),
                       static_cast<float>(i / 10'000), radius});
  return spheres;
}

void expect_answer_of_grid(const Chain& chain, std::uint64_t least_pairs) {
  const Collisions expected = answer_of("Grid", chain);
  ASSERT_GT(expected.pair_count, least_pairs);
  for (const char* name : {"DeviceGrid", "DeviceGrid(binned=0)", "DeviceHybrid(crowd=0)"}) {
    const Collisions found = answer_of(name, chain);
    EXPECT_TRUE(found.pairs == expected.pairs) << name << ": " << found.pair_count << " pairs";
    EXPECT_TRUE(found.count == expected.count) << name;
  }
}

/// More spheres by octaves than a search has threads.
TEST_F(DeviceCells, OfOctavesInManyRounds) {
  auto spheres = lattice_of_hundreds(700'000, 0.55f);
  spheres.insert(spheres.begin(), {-8, 0, 0, 8});
  spheres.push_back({107, 90, 60, 8});
  expect_answer_of_grid(Chain(std::move(spheres)), 1'300'000);
}

/// And of one level, each near so many that a warp has room for those of one round, and not of the next: they
/// touch along the edges of cubes, and across their faces.
TEST_F(DeviceCells, OfMorePairsInTwoRoundsThanAWarpHasRoomFor) {
  expect_answer_of_grid(Chain(lattice_of_hundreds(700'000, 0.72f)), 5'000'000);
}

/// In one place: threads that come first count more pairs than 16 bits tell.
TEST_F(DeviceCells, OfMoreThan65535PairsAThread) {
  constexpr std::uint32_t n = 80'000;
  const Chain chain(std::vector<Sphere>(n, Sphere{1, 2, 3, 4}));
  std::vector<std::uint32_t> expected(n, n - 3);  // all but itself and its neighbours
  expected.front() = expected.back() = n - 2;
  for (const char* name : {"DeviceGrid", "DeviceLBVH"}) {
    const Collisions found = answer_of(name, chain, counts);
    EXPECT_EQ(found.pair_count, std::uint64_t{n} * (n - 1) / 2 - (n - 1)) << name;
    EXPECT_TRUE(found.count == expected) << name;
  }
}

}  // namespace
}  // namespace catena::properties
