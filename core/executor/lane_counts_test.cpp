#include "catena/core/executor/lane_counts.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "catena/core/executor/host_group.h"
#include "catena/core/scenes/random.h"

namespace catena {
namespace {

/// Counts past what a byte holds, handed over page by page in parts, again and again; what an unfinished
/// search left is forgotten.
TEST(LaneCounts, AddUpWhateverALaneCounted) {
  Random random(4);
  const auto below = [&](std::size_t n) {
    return static_cast<std::uint32_t>(random.unit() * static_cast<double>(n));
  };
  LaneCounts lanes[2];
  for (int round = 0; round < 60; ++round) {
    const std::size_t size = round % 4 == 3 ? 5000 : 9001;  // pages of 4,096, the last one cut
    const bool unfinished = round % 5 == 4;
    std::vector<std::uint32_t> expected(size), counts(size, 0);
    for (LaneCounts& lane : lanes) {
      lane.reset(size);
      constexpr std::uint32_t around[] = {254, 255, 256, 257, 511, 512};  // what a byte holds
      const std::uint32_t often = 20 + below(size - 20), times = round < 6 ? around[round] : below(1400);
      for (std::uint32_t k = 0; k < times; ++k) lane.add(often), ++expected[often];
      std::vector<Pair> pairs;
      for (std::uint32_t k = 0; k < (round < 6 ? around[round] : 300); ++k) {
        pairs.push_back({round < 6 ? 0 : below(20), 1 + below(19)});
        ++expected[pairs.back().i], ++expected[pairs.back().j];
      }
      lane.add(pairs);
    }
    if (unfinished) continue;
    const auto pages = static_cast<std::uint32_t>((size + LaneCounts::page - 1) / LaneCounts::page);
    for (std::uint32_t begin = 0; begin < pages + 1; ++begin)
      for (LaneCounts& lane : lanes) lane.move_pages_to(counts, begin, begin + 1);
    for (LaneCounts& lane : lanes) lane.move_full_to(counts);
    EXPECT_EQ(counts, expected) << round;
  }
}

/// Nothing before the barrier; then each thread all that is its own, the last one first, loop by loop; once.
TEST(HostGroup, RunsAtABarrierThreadByThread) {
  struct Step {
    int loop;
    std::uint32_t k;
    bool operator==(const Step&) const = default;
  };
  std::vector<Step> steps;
  auto* const to = &steps;
  HostGroup group(3);
  EXPECT_EQ(group.threads(), 3u);
  group.parallel(5, [=](std::uint32_t k) { to->push_back({0, k}); });
  group.parallel(2, [=](std::uint32_t k) { to->push_back({1, k}); });
  EXPECT_TRUE(steps.empty());
  group.barrier();
  EXPECT_EQ(steps, (std::vector<Step>{{0, 2}, {0, 1}, {0, 4}, {1, 1}, {0, 0}, {0, 3}, {1, 0}}));
  steps.clear();
  group.barrier();
  EXPECT_TRUE(steps.empty()) << "each loop once";
  for (int loop = 0; loop < 8; ++loop) group.parallel(1, [=](std::uint32_t k) { to->push_back({loop, k}); });
  EXPECT_THROW(group.parallel(1, [](std::uint32_t) {}), std::logic_error);
  group.barrier();
  EXPECT_EQ(steps.size(), 8u);
}

}  // namespace
}  // namespace catena
