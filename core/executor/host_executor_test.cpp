#include "catena/core/executor/host_executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "catena/core/executor/usable_cores.h"

namespace catena {
namespace {

HostExecutor executor(const std::string& settings) {
  return HostExecutor(Parameters("test", {HostExecutor::threads_parameter()}, settings));
}

/// As many threads as were asked for, or one for so many items as are worth it.
TEST(HostExecutor, StartsAThreadWhereItIsWorthOne) {
  const Decision asked = executor("threads=3").decision(100);
  EXPECT_EQ(asked.reason, "3 of 3 for 100 spheres");
  EXPECT_FALSE(asked.left_out);
  EXPECT_EQ(executor("threads=7").decision(4).reason, "4 of 7 for 4 spheres: one is worth starting for 4096");
  EXPECT_TRUE(executor("threads=7").decision(4).left_out);
  const std::string cores = std::to_string(usable_cores());
  const Decision few = executor("").decision(100);
  EXPECT_EQ(few.left_out, usable_cores() > 1);
  EXPECT_TRUE(few.reason.starts_with("1 of " + cores + " for 100 spheres")) << few.reason;
  const Decision many = executor("").decision(1u << 30);
  EXPECT_EQ(many.reason, cores + " of " + cores + " for 1073741824 spheres");
  EXPECT_FALSE(many.left_out);
}

TEST(HostExecutor, RunsEachBlockOnceAndThrowsWhatOneThrows) {
  for (const char* threads : {"threads=1", "threads=3", "threads=7"}) {
    std::vector<std::atomic<int>> times(20);
    executor(threads).for_each_block(20, 2, [&](HostGroup& group, std::uint32_t block) {
      EXPECT_EQ(group.threads(), 2u);
      ++times[block];
    });
    for (const auto& once : times) EXPECT_EQ(once, 1);
    for (const std::uint32_t bad : {0u, 19u})
      EXPECT_THROW(executor(threads).for_each_block(20, 2,
                                                    [&](HostGroup&, std::uint32_t block) {
                                                      if (block == bad) throw std::runtime_error("block");
                                                    }),
                   std::runtime_error)
          << threads << ' ' << bad;
  }
}

}  // namespace
}  // namespace catena
