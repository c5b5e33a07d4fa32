#include "catena/core/cells/level_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "catena/core/cells/octave.h"

namespace catena {
namespace {

/// A map with memory of its own.
class Map {
 public:
  explicit Map(std::uint32_t spheres) : map_(LevelMap::of(spheres)), word_(map_.words()) {
    map_.word = word_.data();
  }
  const LevelMap* operator->() const { return &map_; }

 private:
  LevelMap map_;
  std::vector<std::uint32_t> word_;
};

using Place = std::array<double, 3>;
PointCell cell(const Place& at) { return {{at[0], 0, 0}, {at[1], 0, 0}, {at[2], 0, 0}}; }

TEST(LevelMap, HasBitsForAllSpheres) {
  for (const std::uint32_t n : {0u, 1u, 1000u, 1'000'000u, (1u << 26) - 1, 1u << 26, (1u << 31) - 1}) {
    const LevelMap map = LevelMap::of(n);
    EXPECT_GE(map.words(), std::min(n, 1u << 26)) << n;
    EXPECT_LE(map.words(), std::max(2 * n, 128u)) << n;
  }
}

/// Across the borders of cubes, around 0, and as far out as cells are numbered.
TEST(LevelMap, KnowsOfEachCellNextToAMarkedOne) {
  std::mt19937 random(11);
  for (const double from : {-40.0, 0.0, 1e6, -1e7, BucketMap::far_cell - 40, -BucketMap::far_cell + 1})
    for (int round = 0; round < 300; ++round) {
      const Map map(1);
      const auto along = [&] { return from + static_cast<double>(random() % 36); };
      const Place marked{along(), along(), along()};
      const std::uint32_t level = random() % Octaves::count;
      map->mark(cell(marked), level);
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z)
            ASSERT_TRUE(map->any_near(cell({marked[0] + x, marked[1] + y, marked[2] + z}), level))
                << marked[0] << ' ' << marked[1] << ' ' << marked[2];
    }
}

/// Of cells far from all others, and of levels with nobody near, nearly all are left out.
TEST(LevelMap, SaysOfMostOthersThatNobodyIsNear) {
  std::mt19937 random(12);
  constexpr int spheres = 20'000;
  const Map map(spheres);
  EXPECT_FALSE(map->any_near(cell({0, 0, 0}), 0));
  const auto place = [&] {
    const auto along = [&] { return static_cast<double>(random() % 2'000'000) - 1e6; };
    return Place{along(), along(), along()};
  };
  std::vector<Place> marked;
  for (int k = 0; k < spheres; ++k) marked.push_back(place()), map->mark(cell(marked.back()), 7);
  int elsewhere = 0, at_other_levels = 0;
  for (const Place& at : marked) {
    elsewhere += map->any_near(cell(place()), 7);
    for (const std::uint32_t level : {0u, 6u, 8u, Octaves::count - 1})
      at_other_levels += map->any_near(cell(at), level);
  }
  EXPECT_LT(elsewhere, spheres / 10);
  EXPECT_LT(at_other_levels, 4 * spheres / 10);
}

}  // namespace
}  // namespace catena
