#include "catena/core/parts/greatest_radii.h"

#include <gtest/gtest.h>

#include <random>

namespace catena::parts {
namespace {

TEST(GreatestRadii, VisitAllThatMayBeAmongSome) {
  std::mt19937 dice(3);
  std::size_t visits = 0;
  for (const std::size_t n : {1u, 2u, 15u, 16u, 17u, 255u, 256u, 300u, 5000u}) {
    std::vector<float> radii;
    for (std::size_t k = 0; k < n; ++k)
      radii.push_back(dice() % 7 == 0 ? static_cast<float>(dice() % 100) : 1);
    const GreatestRadii greatest(radii);
    for (int round = 0; round < 50; ++round) {
      const std::size_t begin = dice() % n, end = begin + dice() % (n + 1 - begin);
      const float least = static_cast<float>(dice() % 120);
      std::vector<std::size_t> visited, due;
      greatest.for_each(
          begin, end,
          [&](std::size_t first, std::size_t last, float radius) {
            EXPECT_LE(begin, first);
            EXPECT_LE(first, last);
            EXPECT_LT(last, end);
            return radius >= least;
          },
          [&](std::size_t k) { visited.push_back(k); });
      for (std::size_t k = begin; k < end; ++k)
        if (radii[k] >= least) due.push_back(k);
      EXPECT_EQ(visited, due);
      visits += due.size();
    }
  }
  EXPECT_GT(visits, 1000u);
}

/// One great sphere among many is found by a few looks, whichever it is, and that there is none by fewer.
TEST(GreatestRadii, AreFewLooks) {
  constexpr std::size_t n = 1 << 20, levels = 6, fan = 16;
  std::vector<float> radii(n, 1);
  radii[777'777] = 5;
  const GreatestRadii greatest(radii);
  for (const float least : {5.0f, 6.0f}) {
    std::size_t looks = 0, visits = 0;
    const auto may = [&](std::size_t, std::size_t, float radius) { return ++looks, radius >= least; };
    greatest.for_each(3, n - 3, may, [&](std::size_t k) {
      ++visits;
      EXPECT_EQ(k, 777'777u);
    });
    EXPECT_EQ(visits, least == 5 ? 1u : 0u);
    EXPECT_LE(looks, least == 5 ? levels * fan : 1);
  }
}

}  // namespace
}  // namespace catena::parts
