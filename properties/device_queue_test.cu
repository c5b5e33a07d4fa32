#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "catena/cuda/near_queue.cuh"
#include "catena/cuda/pair_stage.cuh"
#include "catena/properties/testing/answer_of.h"
#include "catena/properties/testing/no_device.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"

// A warp's room for what it gathers, filled by one warp to the last place, to one less and to one more.
namespace catena::properties {
namespace {

class DeviceQueue : public testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = no_device()) GTEST_SKIP() << *why;
  }
};

/// `together` spheres of which each overlaps all others, and one more that overlaps the last `met` of them;
/// then others far away, up to `size`. Each is a strand, so that none are neighbours.
Chain crowd_and_one(std::uint32_t together, std::uint32_t met, std::uint32_t size) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < together; ++k) spheres.push_back({static_cast<float>(k) / 64, 0, 0, 1});
  spheres.push_back({2 + (static_cast<float>(together - met) - 0.5f) / 64, 0, 0, 1});
  while (spheres.size() < size) spheres.push_back({0, 8 * static_cast<float>(spheres.size()), 0, 1});
  std::vector<std::uint32_t> first(spheres.size() + 1);
  std::iota(first.begin(), first.end(), 0u);
  return Chain(std::move(spheres), Strands{std::move(first), {}});
}

void expect_all_found(const Chain& chain, std::uint64_t pairs, const std::vector<std::string>& names) {
  const auto exact = reference::find(chain);
  ASSERT_EQ(exact.pair_count, pairs);
  for (const std::string& name : names) {
    EXPECT_TRUE(reference::compare(chain, exact, answer_of(name, chain)).right()) << name << ", " << pairs;
    EXPECT_TRUE(
        reference::compare_counts(exact, answer_of(name, chain, {.want = Request::Want::counts})).right())
        << name << ", " << pairs;
  }
}

/// Of 32 spheres, which are a warp's.
TEST_F(DeviceQueue, OfOneWarpIsFilledToItsEdge) {
  constexpr std::uint32_t room = cuda::NearQueue<128>::room, together = 28,
                          pairs = together * (together - 1) / 2;
  static_assert(pairs < room && room < pairs + together);
  for (std::uint32_t met = room - pairs - 1; met <= room - pairs + 1; ++met)
    expect_all_found(crowd_and_one(together, met, 32), pairs + met,
                     {"DeviceGrid", "DeviceHybrid", "DeviceLBVH"});
}

/// Of blocks that one warp compares: what one has within itself, and what it has with the next.
TEST_F(DeviceQueue, OfComparedBlocksIsFilledToItsEdge) {
  constexpr std::uint32_t room = cuda::PairStage<128>::room, together = 32,
                          pairs = together * (together - 1) / 2;
  static_assert(pairs < room && room < pairs + together);
  for (std::uint32_t met = room - pairs - 1; met <= room - pairs + 1; ++met)
    expect_all_found(crowd_and_one(together, met, 64), pairs + met,
                     {"DeviceTree", "DeviceCapsules", "DeviceHybrid(least=0,survey=0)"});
}

}  // namespace
}  // namespace catena::properties
