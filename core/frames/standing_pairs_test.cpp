#include "catena/core/frames/standing_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace catena {
namespace {

TEST(StandingPairs, AreThoseThatCameAndDidNotGo) {
  std::mt19937 random(3);
  constexpr std::uint32_t n = 40, listed = 300;
  std::vector<std::uint32_t> spheres(n);  // of places
  for (std::uint32_t k = 0; k < n; ++k) spheres[k] = k * 7 % n;
  std::vector<Pair> list;
  for (std::uint32_t i = 0; list.size() < listed; ++i)
    for (std::uint32_t j = i + 1; j < n && list.size() < listed; ++j)
      list.push_back(random() % 2 ? Pair{i, j} : Pair{j, i});
  StandingPairs standing;
  standing.clear(listed);
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> counts(n, 0);
  std::vector<bool> stands(listed, false);
  for (int frame = 0; frame < 200; ++frame) {
    // Now many come, now many go, now as many of each.
    const unsigned come = frame % 3 == 0 ? 20 : 5, go = frame % 3 == 1 ? 60 : frame % 3 == 2 ? 5 : 2;
    std::vector<std::uint32_t> changed;
    for (std::uint32_t k = 0; k < listed; ++k)
      if (random() % 100 < (stands[k] ? go : come)) changed.push_back(k), stands[k] = !stands[k];
    standing.exchange(changed, list, spheres, pairs, counts);
    std::vector<Pair> wanted, found = pairs;
    std::vector<std::uint32_t> wanted_counts(n, 0);
    for (std::uint32_t k = 0; k < listed; ++k) {
      if (!stands[k]) continue;
      const auto [low, high] = std::minmax(spheres[list[k].i], spheres[list[k].j]);
      wanted.push_back({low, high});
      ++wanted_counts[low], ++wanted_counts[high];
    }
    std::ranges::sort(wanted), std::ranges::sort(found);
    ASSERT_EQ(found, wanted) << "frame " << frame;
    ASSERT_EQ(counts, wanted_counts) << "frame " << frame;
  }
}

}  // namespace
}  // namespace catena
