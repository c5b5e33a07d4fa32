#include "catena/core/space_tree/key_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "catena/core/parameters/parameters.h"

namespace catena {
namespace {

Team team_of(unsigned threads) {
  return Team(Parameters("test", {Team::threads_parameter()}, "threads=" + std::to_string(threads)));
}

/// What is given in upper halves, each with a number of its own below.
template <class Upper>
std::vector<std::uint64_t> keys_of(std::size_t n, const Upper& upper) {
  std::vector<std::uint64_t> keys(n);
  for (std::size_t k = 0; k < n; ++k) keys[k] = std::uint64_t{upper(k)} << 32 | k;
  return keys;
}

TEST(KeySort, SortsByAnyNumberOfThreadsWhateverOrderKeysAreIn) {
  std::mt19937 random(5);
  const auto expect_sorted = [](const std::vector<std::uint64_t>& keys) {
    std::vector<std::uint64_t> expected = keys;
    std::ranges::sort(expected);
    for (const unsigned threads : {1u, 2u, 3u, 5u, 16u, 17u}) {
      const Team team = team_of(threads);
      std::vector<std::uint64_t> sorted = keys;
      KeySort sort;
      for (int again = 0; again < 2; ++again) {
        sort(sorted, team);
        EXPECT_EQ(sorted, expected) << keys.size() << " keys by " << threads;
        sorted = keys;
      }
    }
  };
  for (const std::size_t n : {KeySort::few - 1, KeySort::few, 3 * KeySort::few + 7}) {
    expect_sorted(keys_of(n, [&](std::size_t) { return static_cast<std::uint32_t>(random()); }));
    expect_sorted(keys_of(n, [&](std::size_t) { return static_cast<std::uint32_t>(random() % 3); }));
    expect_sorted(keys_of(n, [](std::size_t k) { return static_cast<std::uint32_t>(k / 5); }));
    expect_sorted(keys_of(n, [](std::size_t) { return ~0u; }));
    auto greatest = keys_of(n, [](std::size_t k) { return static_cast<std::uint32_t>(~k); });
    greatest[n / 2] = std::numeric_limits<std::uint64_t>::max();
    expect_sorted(greatest);
  }
}

/// Where each key goes cannot be foretold then: a search for it by branches took six times as long.
TEST(KeySort, TakesLittleLongerWhereKeysAreInNoOrder) {
  constexpr std::size_t n = 1 << 17;
  std::mt19937 random(5);
  const auto mixed = keys_of(n, [&](std::size_t) { return static_cast<std::uint32_t>(random()); });
  const auto ordered = keys_of(n, [](std::size_t k) { return static_cast<std::uint32_t>(k << 12); });
  const Team team = team_of(2);
  KeySort sort;
  std::vector<std::uint64_t> keys;
  const auto least_of_several = [&](const std::vector<std::uint64_t>& of) {
    auto least = std::numeric_limits<std::clock_t>::max();
    for (int k = 0; k < 9; ++k) {
      keys = of;
      const std::clock_t begin = std::clock();  // of the processor, by all threads
      sort(keys, team);
      least = std::min(least, std::clock() - begin);
    }
    return least;
  };
  EXPECT_LT(least_of_several(mixed), 3 * least_of_several(ordered));
}

}  // namespace
}  // namespace catena
