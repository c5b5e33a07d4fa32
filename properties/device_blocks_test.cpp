#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "catena/core/cells/block_nodes.h"
#include "catena/core/error.h"
#include "catena/properties/testing/answer_of.h"
#include "catena/properties/testing/no_device.h"
#include "catena/properties/testing/rods.h"

// Chains of so many blocks that their tree has levels between its top and the blocks, and kernels more to do
// than a device has threads for at a time: what short chains never ask of them.
namespace catena::properties {
namespace {

class DeviceBlocks : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = no_device()) GTEST_SKIP() << *why;
  }
};

/// Two strands side by side, each sphere of which touches the one beside it: nodes meet one another along
/// both, in trees of two levels and of four, by large thread blocks and by many small ones.
TEST_F(DeviceBlocks, FindWhatTwoStrandsMeetInTreesOfManyLevels) {
  for (const std::uint32_t blocks : {10'000u, 30'000u, 140'000u}) {
    const std::uint32_t each = blocks * block;
    EXPECT_EQ(BlockNodes::over(2 * blocks).top, blocks == 140'000u ? 4u : blocks == 30'000u ? 3u : 2u);
    std::vector<Sphere> spheres;
    for (const float y : {0.0f, 1.875f})
      for (std::uint32_t k = 0; k < each; ++k) spheres.push_back({1.5f * static_cast<float>(k), y, 0, 1});
    const Chain chain(std::move(spheres), Strands{{0, each, 2 * each}, {}});
    std::vector<Pair> expected;
    for (std::uint32_t k = 0; k < each; ++k) expected.push_back({k, each + k});
    for (const char* name : {"DeviceHybrid", "DeviceHybrid(cells=0)",
                             "DeviceHybrid(survey=0,cells=4294967295)", "DeviceCapsules", "DeviceTree"}) {
      const Collisions found = answer_of(name, chain);
      EXPECT_TRUE(found.pairs == expected) << name << ": " << found.pair_count << " pairs";
      EXPECT_TRUE(found.count == std::vector<std::uint32_t>(2 * each, 1)) << name;
    }
  }
}

/// Three blocks at a place, of which each sphere overlaps all others: far more pairs than a warp has room for
/// between two looks at the answer.
TEST_F(DeviceBlocks, FindMorePairsThanAWarpHasRoomFor) {
  constexpr std::uint32_t places = 1000, together = 3 * block;
  std::vector<Sphere> spheres;
  std::vector<Pair> expected;
  std::vector<std::uint32_t> count(places * together, together - 1);
  for (std::uint32_t i = 0; i < places * together; ++i) {
    spheres.push_back(
        {128 * static_cast<float>(i / together), 0.0078125f * static_cast<float>(i % together), 0, 1});
    for (std::uint32_t j = i + 1; j < (i / together + 1) * together; ++j)
      if (j > i + 1 || j % block == 0)
        expected.push_back({i, j});
      else
        --count[i], --count[j];
  }
  const Chain chain = each_block_a_strand(spheres);
  for (const std::string name :
       {"DeviceHybrid(least=0,survey=0)", "DeviceHybrid(least=0,survey=0,crowd=1)", "DeviceTree"}) {
    const Collisions found = answer_of(name, chain);
    EXPECT_TRUE(found.pairs == expected) << name << ": " << found.pair_count << " pairs";
    EXPECT_TRUE(found.count == count) << name;
    const Collisions counted = answer_of(name, chain, {.want = Request::Want::counts});
    EXPECT_EQ(counted.pair_count, expected.size()) << name;
    EXPECT_TRUE(counted.count == count) << name;
    EXPECT_TRUE(answer_of(name, chain, {.want = Request::Want::any}).found) << name;
    try {
      answer_of(name, chain, {Request::Want::pairs, expected.size() - 1});
      ADD_FAILURE() << name << " takes one pair more than it may";
    } catch (const PairLimitExceeded& error) {
      EXPECT_EQ(error.found(), expected.size()) << name;
    }
  }
}

/// Ten million spheres in pairs of rods that cross, all tangled: more blocks than any kernel takes in one
/// round.
TEST_F(DeviceBlocks, FindAllThatTangledBlocksMeetInManyRounds) {
  constexpr std::uint32_t crossings = 157'000, side = 54, step = 97'031;
  static_assert(crossings <= side * side * side && crossings % step != 0);
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> expected(std::size_t{crossings} * 2 * block);
  for (std::uint32_t k = 0; k < crossings; ++k) {
    const auto place = static_cast<std::uint32_t>(std::uint64_t{k} * step % crossings);
    const float x = 128 * static_cast<float>(place % side), y = 128 * static_cast<float>(place / side % side),
                z = 128 * static_cast<float>(place / side / side);
    add_rod(spheres, x, y, z), add_rod(spheres, x, y, z + 1.5f, true);
    for (const std::uint32_t rod : {2 * k, 2 * k + 1})
      for (const std::uint32_t middle : {block / 2 - 1, block / 2}) expected[rod * block + middle] = 2;
  }
  const Chain chain = each_block_a_strand(spheres);
  for (const char* name : {"DeviceHybrid", "DeviceHybrid(binned=4294967295)", "DeviceCapsules"}) {
    const Collisions found = answer_of(name, chain, {.want = Request::Want::counts});
    EXPECT_EQ(found.pair_count, std::uint64_t{4} * crossings) << name;
    EXPECT_TRUE(found.count == expected) << name;
  }
}

}  // namespace
}  // namespace catena::properties
