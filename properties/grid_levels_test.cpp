#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/reference.h"

// Great spheres far from one another, and by each a crowd of small ones, which are a level of their own: of
// the great spheres' cells, which share buckets by chance, each small one looks only into those within its
// reach.
namespace catena::properties {
namespace {

constexpr std::uint32_t crowds = 250, crowd = 12;

Chain great_and_small(Dice& dice, float far) {
  std::vector<Sphere> spheres, small;
  for (std::uint32_t k = 0; k < crowds; ++k) {
    const Sphere great{far * dice.symmetric(), far * dice.symmetric(), far * dice.symmetric(), 1};
    spheres.push_back(great);
    float way[3] = {dice.symmetric(), dice.symmetric(), dice.symmetric()};
    if (dice.one_in(2)) way[dice.below(3)] *= 1e6f;  // as far along an axis as any that touch
    const float length = std::hypot(way[0], way[1], way[2]) + 1e-9f;
    for (std::uint32_t s = 0; s < crowd; ++s) {
      const float radius = 0.2f * dice.unit(), away = (1 + radius) * dice.pick({0.7f, 0.999f, 1.0f}) / length;
      small.push_back({great.x + away * way[0], great.y + away * way[1], great.z + away * way[2], radius});
    }
  }
  spheres.insert(spheres.end(), small.begin(), small.end());
  return Chain(spheres);
}

TEST(GridLevels, SmallSpheresFindGreatOnesInCellsThatShareBuckets) {
  std::uint64_t seed = 40;
  for (const float far : {30.0f, 1e3f, 1e5f, 1e7f})
    for (int k = 0; k < 25; ++k) {
      Dice dice(++seed);
      const Chain chain = great_and_small(dice, far);
      const reference::Answer right = reference::find(chain);
      const auto grid = StrategyRegistry::instance().make("Grid");
      Collisions found;
      grid->build(chain);
      grid->find(chain, {}, found);
      sort(found.pairs);
      ASSERT_GT(right.pair_count, crowds);
      ASSERT_TRUE(found.pairs == right.pairs)
          << "seed " << seed << ": " << found.pairs.size() << " pairs, right " << right.pairs.size();
    }
}

}  // namespace
}  // namespace catena::properties
