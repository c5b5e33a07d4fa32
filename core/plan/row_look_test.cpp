#include "catena/core/plan/row_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace catena {
namespace {

constexpr std::uint32_t numbers[] = {32, 40, 100, 127, 128, 129, 1000, 2048, 100'003};

/// Rows that are near all others: all but itself and the two beside it, of rows that have two.
TEST(RowLook, CountsAllRowsWhereAllAreNear) {
  for (const std::uint32_t n : numbers) {
    std::vector<Sphere> spheres(n, {1, 2, 3, 0.5f});
    const std::uint32_t rows = n / 8;
    const RowLook look = RowLook::at(spheres);
    EXPECT_GE(look.near, rows - 3) << n;
    EXPECT_LE(look.near, rows - 2) << n;
    EXPECT_EQ(look.straight, 1) << "nothing was gone";
  }
}

TEST(RowLook, OfAStraightChainIsNone) {
  for (const std::uint32_t n : numbers) {
    std::vector<Sphere> spheres;
    for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.9f});
    const RowLook look = RowLook::at(spheres);
    EXPECT_EQ(look.near, 0) << n;
    EXPECT_EQ(look.straight, 1) << n;
  }
}

/// Too few to say anything.
TEST(RowLook, OfFewerThanFourRowsIsTheDefault) {
  const std::vector<Sphere> spheres(31, {0, 0, 0, 1});
  for (std::size_t n = 0; n <= spheres.size(); ++n)
    EXPECT_EQ(RowLook::at(std::span(spheres).first(n)).near, 0);
}

/// Rows of which each is near those up to so many away, and no others: what is near along the chain is not
/// missed, however long the chain is. Four or eight looks tell it to within some of them.
TEST(RowLook, FindsWhatIsNearAlongTheChain) {
  for (const std::uint32_t n : {1000u, 2048u, 100'003u})
    for (const float away : {3.f, 10.f, 40.f}) {
      std::vector<Sphere> spheres;
      for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i / 8), 0, 0, away / 2});
      const RowLook look = RowLook::at(spheres);
      EXPECT_GE(look.near, 0.6 * 2 * (away - 1)) << n << ' ' << away;
      EXPECT_LE(look.near, 1.6 * 2 * (away - 1)) << n << ' ' << away;
    }
}

TEST(RowLook, TellsAnOrderFromNone) {
  std::mt19937 dice(5);
  std::normal_distribution<float> step;
  for (const std::uint32_t n : {100u, 1000u, 100'000u}) {
    std::vector<Sphere> walk{{0, 0, 0, 0.1f}}, gas;
    for (std::uint32_t i = 0; i < n; ++i) {
      const Sphere& s = walk.back();
      walk.push_back({s.x + step(dice), s.y + step(dice), s.z + step(dice), 0.1f});
      gas.push_back({step(dice), step(dice), step(dice), 0.1f});
    }
    EXPECT_GT(RowLook::at(walk).straight, 0.25) << n;
    EXPECT_LT(RowLook::at(gas).straight, 0.25) << n;
  }
}

}  // namespace
}  // namespace catena
