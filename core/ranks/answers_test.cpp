// How answers go home to the ranks that their spheres belong to.
#include "catena/core/ranks/answers.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "catena/core/ranks/thread_ranks.h"

namespace catena::ranks {
namespace {

/// What is found is told by those numbers to the ranks that they belong to.
TEST(ReturnedAnswers, GoHomeByNumbersOf64Bits) {
  const SphereId start = SphereId{1} << 33;
  const std::vector<SphereId> starts{0, start, start, start + 10};
  run_in_threads(3, [&](Communicator& c) {
    const std::vector<SphereId> counted_from{start - 5, start, start, start + 10};
    // Runs that end, begin and lie in the spheres of the last rank, and single ones.
    const std::vector<std::uint32_t> across{7, 2, 3}, within{1};
    std::vector<std::uint64_t> count;
    if (c.rank() == 2)
      count = return_counts(c, counted_from, std::vector<CountRun>{{start - 1, across}, {start + 3, within}},
                            std::vector<Counted>{{start + 3, 5}, {start + 9, 1}});
    else
      count = return_counts(c, counted_from, {}, std::vector<Counted>{{start + 3, 1}, {start + 9, 1}});
    if (c.rank() == 0) {
      EXPECT_EQ(count, (std::vector<std::uint64_t>{0, 0, 0, 0, 7}));
    }
    if (c.rank() == 1) {
      EXPECT_TRUE(count.empty());
    }
    if (c.rank() == 2) {
      EXPECT_EQ(count, (std::vector<std::uint64_t>{2, 3, 0, 8, 0, 0, 0, 0, 0, 3}));
    }
    const auto pairs =
        return_pairs(c, starts, PairLists{{{start + 2 - c.rank(), start + 7}}, {}, {{5, start + 1}}});
    if (c.rank() == 0) {
      EXPECT_EQ(pairs, (std::vector<IdPair>{{5, start + 1}, {5, start + 1}, {5, start + 1}}));
    }
    if (c.rank() == 1) {
      EXPECT_TRUE(pairs.empty());
    }
    if (c.rank() == 2) {
      EXPECT_EQ(pairs,
                (std::vector<IdPair>{{start, start + 7}, {start + 1, start + 7}, {start + 2, start + 7}}));
    }
  });
}

/// Also runs that are longer than what is read of a message at once.
TEST(ReturnedAnswers, OfLongRunsAreComplete) {
  constexpr std::uint32_t size = 5000;
  std::vector<std::uint32_t> counts(size);
  std::iota(counts.begin(), counts.end(), 1u);
  run_in_threads(2, [&](Communicator& c) {
    const std::vector<SphereId> starts{0, size, size};
    std::vector<std::uint64_t> twice(counts.begin(), counts.end());
    for (auto& count : twice) count *= 2;
    const std::vector<Counted> more{{2, 5}};
    const auto found = return_counts(c, starts, std::vector<CountRun>{{0, counts}}, more);
    twice[2] += 10;
    EXPECT_EQ(found, c.rank() == 0 ? twice : std::vector<std::uint64_t>());
  });
}

}  // namespace
}  // namespace catena::ranks
