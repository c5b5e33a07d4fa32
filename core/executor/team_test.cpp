#include "catena/core/executor/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catena/core/strategy/timings.h"

namespace catena {
namespace {

Parameters threads(const std::string& number) {
  return Parameters("test", {Team::threads_parameter()}, "threads=" + number);
}

TEST(Team, SharesOutEveryItemOnce) {
  for (const char* const size : {"1", "2", "5"}) {
    const Team team(threads(size));
    for (const std::uint32_t n : {0u, 1u, 7u, 1000u}) {
      std::vector<std::atomic<int>> done(n);
      team.for_each_range(n, 3, [&](std::uint32_t begin, std::uint32_t end) {
        EXPECT_LT(begin, end);
        for (std::uint32_t k = begin; k < end; ++k) ++done[k];
      });
      for (const auto& times : done) EXPECT_EQ(times, 1);
    }
  }
}

TEST(Team, NoTwoRangesRunAtATimeByOneMember) {
  const Team team(threads("4"));
  std::vector<std::atomic<int>> busy(team.size());
  std::atomic<bool> twice = false;
  team.for_each_range(2000, 1, [&](std::uint32_t, std::uint32_t) {
    ASSERT_LT(team.member(), team.size());
    auto& mine = busy[team.member()];
    if (mine.fetch_add(1) != 0) twice = true;
    for (int k = 0; k < 1000; ++k) static_cast<void>(mine.load());
    mine.fetch_sub(1);
  });
  EXPECT_FALSE(twice);
}

TEST(Team, MaySharePartsOfARange) {
  const Team team(threads("3"));
  std::atomic<int> done = 0;
  team.for_each_range(20, 1, [&](std::uint32_t, std::uint32_t) {
    team.for_each_range(
        30, 1, [&](std::uint32_t begin, std::uint32_t end) { done += static_cast<int>(end - begin); });
  });
  EXPECT_EQ(done, 600);
}

TEST(Team, ThrowsWhatARangeThrows) {
  for (const char* const size : {"1", "3"}) {
    const Team team(threads(size));
    EXPECT_THROW(
        team.for_each_range(100, 1, [](std::uint32_t, std::uint32_t) { throw std::runtime_error("stop"); }),
        std::runtime_error);
  }
}

TEST(Team, OfOneIsTheCaller) {
  const Team alone;
  EXPECT_EQ(alone.size(), 1u);
  EXPECT_EQ(alone.member(), 0u);
  std::vector<std::uint32_t> seen;
  alone.for_each_range(5, 2, [&](std::uint32_t begin, std::uint32_t end) {
    EXPECT_EQ(alone.member(), 0u);
    for (std::uint32_t k = begin; k < end; ++k) seen.push_back(k);
  });
  EXPECT_EQ(seen, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
  const Team others(threads("0"));
  std::atomic<unsigned> met = 0;
  others.for_each_range(others.size(), 1, [&](std::uint32_t, std::uint32_t) {
    ++met;
    for (const Stopwatch watch; met < others.size() && watch.ms() < 500;) std::this_thread::yield();
    EXPECT_EQ(alone.member(), 0u) << "by whichever thread of another team";
  });
}

TEST(Team, MayBeCalledByATeam) {
  const Team outer(threads("2")), inner(threads("2"));
  std::atomic<int> done = 0;
  outer.for_each_range(8, 1, [&](std::uint32_t, std::uint32_t) {
    inner.for_each_range(8, 1, [&](std::uint32_t begin, std::uint32_t end) {
      ASSERT_LT(inner.member(), inner.size());
      done += static_cast<int>(end - begin);
    });
  });
  EXPECT_EQ(done, 64);
}

/// Who sorts little does so at once, outside a body.
TEST(Team, HasAMemberBelowItsSizeOutsideABody) {
  const Team team(Parameters("test", {Team::threads_parameter()}, "threads=0"));
  EXPECT_LT(team.member(), team.size());
}

/// Nor is the number that a thread has in another team's arena one of a smaller team.
TEST(Team, HasAMemberBelowItsSizeInABodyOfALargerTeam) {
  const Team outer(threads("4")), alone;
  std::atomic<int> work = 0;
  outer.for_each_range(400, 1, [&](std::uint32_t, std::uint32_t) {
    EXPECT_EQ(alone.member(), 0u);
    for (int k = 0; k < 10000; ++k) ++work;
  });
}

}  // namespace
}  // namespace catena
