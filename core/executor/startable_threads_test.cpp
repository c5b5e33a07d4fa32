#include "catena/core/executor/startable_threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/executor/host_executor.h"
#include "catena/core/executor/team.h"
#include "catena/core/executor/usable_cores.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/plan/test_plan.h"
#include "catena/properties/testing/sanitized.h"

namespace catena {
namespace {

Team team(const std::string& threads) {
  return Team(Parameters("test", {Team::threads_parameter()}, "threads=" + threads));
}

/// No address is left for so much as a thread's stack.
void leave_little_room() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t room = rlim_t{3} << 20;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(3);
  limit.rlim_cur = pages * 4096 + room;  // what more may be had is left, as few may raise it
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(3);
}

void expect(bool right, int line) {
  if (!right) std::_Exit(line % 256);
}

bool refused(const auto& work) {
  try {
    work();
  } catch (const CapacityError& error) {
    return std::string(error.what()).starts_with("no thread can be started; raise ulimit -u");
  }
  return false;
}

void search_with_few_threads() {
  leave_little_room();
  expect(startable_threads(5) == 0, __LINE__);
  expect(team("0").size() == 1, __LINE__);
  expect(usable_cores() == 1 || refused([] { team("2"); }), __LINE__);
  std::vector<std::atomic<int>> times(20000);
  const auto once = [&](HostGroup&, std::uint32_t block) { ++times[block]; };
  HostExecutor(Parameters("test", {HostExecutor::threads_parameter()}, "")).for_each_block(20000, 1, once);
  for (const auto& time : times) expect(time == 1, __LINE__);
  expect(refused([&] {
           HostExecutor(Parameters("test", {HostExecutor::threads_parameter()}, "threads=3"))
               .for_each_block(9, 1, once);
         }),
         __LINE__);
  const Machine machine = test::sixteen_cores();
  const SearchPlan plan(1u << 24, {}, machine, {});
  expect(plan.threads() == 1, __LINE__);
  expect(test::step(plan.steps(), "further threads").reason ==
             "no more than 1 thread can be had here of 16 that would pay",
         __LINE__);
  std::_Exit(0);
}

/// A container allows few processes, a shell few threads or little memory: what did not ask for threads goes
/// on with those there are.
TEST(StartableThreads, AreDoneWithoutWhereNoneCanBeHad) {
  if (properties::sanitized) GTEST_SKIP() << "a sanitizer takes all addresses";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(search_with_few_threads(), testing::ExitedWithCode(0), "");
}

TEST(StartableThreads, AreAllWhereNothingForbidsThem) {
  EXPECT_EQ(startable_threads(3), 3u);
  EXPECT_EQ(startable_threads(1), 1u);
  EXPECT_EQ(startable_threads(0), 0u);
  EXPECT_EQ(startable_threads(7), 7u);
}

}  // namespace
}  // namespace catena
