#include "catena/core/executor/shared_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace catena {
namespace {

/// Round after round writers write what they will, and the result of one round is the memory of the next.
TEST(SharedPairs, GiveWhatWasWrittenWhateverTheEarlierResult) {
  std::mt19937 random(7);
  const auto up_to = [&](std::uint32_t most) {
    return std::uniform_int_distribution<std::uint32_t>(0, most)(random);
  };
  std::vector<Pair> result;
  std::size_t shrunk = 0, grown = 0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t before = result.size();
    SharedPairs shared(result, up_to(1) * 1'000'000);
    std::vector<SharedPairs::Writer> writers(1 + up_to(4), SharedPairs::Writer(shared));
    std::vector<Pair> all;
    const std::uint32_t most = up_to(1) ? 30'000 : 600, writes = up_to(20);
    for (std::uint32_t k = 0; k < writes; ++k) {
      const auto begin = static_cast<std::uint32_t>(all.size()), size = up_to(most);
      for (std::uint32_t p = begin; p < begin + size; ++p) all.push_back({p, p + 1});
      writers[up_to(static_cast<std::uint32_t>(writers.size()) - 1)].write(std::span(all).subspan(begin));
    }
    const auto each = [&](const auto& body) {
      for (SharedPairs::Writer& writer : writers) body(writer);
    };
    shared.gather(each, result);
    std::sort(result.begin(), result.end());
    ASSERT_EQ(result, all) << "round " << round;
    (all.size() < before ? shrunk : grown) += 1;
  }
  EXPECT_GT(std::min(shrunk, grown), 20u) << "one kind of round was hardly tried";
}

}  // namespace
}  // namespace catena
