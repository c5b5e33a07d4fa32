#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/properties/testing/pairs_found.h"
#include "catena/reference/reference.h"
#include "catena/reference/verify.h"

// Great spheres far from one another, and by each a crowd of small ones, which are a level of their own: of
// the great spheres' cells, which share buckets by chance, each small one looks only into those within its
// reach.
namespace catena::properties {
namespace {

constexpr std::uint32_t crowds = 250, of_a_crowd = 12;

Chain great_and_small(Dice& dice, float far) {
  std::vector<Sphere> spheres, small;
  for (std::uint32_t k = 0; k < crowds; ++k) {
    const Sphere great{far * dice.symmetric(), far * dice.symmetric(), far * dice.symmetric(), 1};
    spheres.push_back(great);
    float way[3] = {dice.symmetric(), dice.symmetric(), dice.symmetric()};
    if (dice.one_in(2)) way[dice.below(3)] *= 1e6f;  // as far along an axis as any that touch
    const float length = std::hypot(way[0], way[1], way[2]) + 1e-9f;
    for (std::uint32_t s = 0; s < of_a_crowd; ++s) {
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
/// Great ones that are a whole number of vectors and one, which lies far from all others, and by each of them
/// a crowd of small ones.
TEST(GridLevels, TheLastOfALevelIsFoundWhereverItLies) {
  Dice dice(7);
  for (const std::uint32_t great : {65u, 66u, 128u, 129u, 193u}) {
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 0; k < great; ++k)
      spheres.push_back({k + 1 == great ? 1e4f : 50 * dice.symmetric(), 50 * dice.symmetric(), 0, 1});
    for (std::uint32_t k = 0; k < great; ++k)
      for (std::uint32_t s = 0; s < of_a_crowd; ++s)
        spheres.push_back({spheres[k].x + 0.9f, spheres[k].y, 0.1f * static_cast<float>(s), 0.01f});
    const Chain chain(spheres);
    EXPECT_TRUE(pairs_found("Grid", chain) == reference::find(chain).pairs) << great;
  }
}

/// What a level's cells are as wide for may be known to the first of several that share a long chain out.
TEST(GridLevels, TheGreatestOfALevelIsFoundWhereverItIsInAChain) {
  constexpr std::uint32_t n = 140'000;
  for (const std::uint32_t at : {10u, 66'000u, 139'000u}) {
    std::vector<Sphere> spheres;
    for (std::uint32_t k = 0; k < n; ++k)
      spheres.push_back({3.0f * static_cast<float>(k % 400), 3.0f * static_cast<float>(k / 400), 0,
                         k % 10 == 9 ? 0.01f : 0.51f});
    std::vector<Pair> right;
    for (std::uint32_t k = at; k < at + 500; k += 5) {  // each with one that it reaches and the others do not
      spheres[k].radius = 1;
      spheres[k + 2] = {spheres[k].x + 1.5f * (k % 2 == 0 ? 1.0f : -1.0f), spheres[k].y, 0, 0.505f};
      right.push_back({k, k + 2});
    }
    EXPECT_TRUE(pairs_found("Grid", Chain(spheres)) == right) << at;
  }
}

/// One sphere, a strand of its own, beside a crowd of another in the next cell, of all numbers about those
/// for which there is room: of the crowd all are neighbours.
TEST(GridLevels, AnyNumberOfCandidatesIsFoundByOneSphere) {
  for (std::uint32_t crowd_size = 2010; crowd_size < 2110; ++crowd_size) {
    std::vector<Sphere> spheres{{0.95f, 0, 0, 1}};
    for (std::uint32_t k = 0; k < crowd_size; ++k)
      spheres.push_back({2.5f, 0.0001f * static_cast<float>(k), k % 2 == 0 ? 0.0f : 1.3f, 1});
    const Chain chain(spheres, {{0, 1, crowd_size + 1}, {0, 0}}, Exclusion::index(5000));
    std::vector<Pair> right;
    for (std::uint32_t k = 0; k < crowd_size; k += 2) right.push_back({0, k + 1});
    for (const char* grid : {"Grid(cells=narrow)", "Grid(cells=wide)"})
      ASSERT_TRUE(pairs_found(grid, chain) == right) << crowd_size << ' ' << grid;
  }
}

/// Every pair of a search in several levels is accounted for, too, once.
TEST(GridLevels, ProveWhatTheyFind) {
  std::uint64_t seed = 90;
  for (const float far : {10.0f, 30.0f, 1e3f, 1e7f})
    for (int k = 0; k < 3; ++k) {
      Dice dice(++seed);
      std::vector<Sphere> spheres;
      for (std::uint32_t g = 0; g < 25; ++g) {
        spheres.push_back({far * dice.symmetric(), far * dice.symmetric(), far * dice.symmetric(), 1});
        for (std::uint32_t s = 0; s < of_a_crowd; ++s) {
          const Sphere& great = spheres[g * (of_a_crowd + 1)];
          spheres.push_back({great.x + 1.1f * dice.symmetric(), great.y + 1.1f * dice.symmetric(),
                             great.z + 1.1f * dice.symmetric(), s < 4 ? 0.2f : 0.02f});
        }
      }
      // Beside the outermost great one, in the next cell, but out of its reach.
      const Sphere outermost = *std::ranges::max_element(spheres, {}, &Sphere::x);
      for (std::uint32_t s = 0; s < 200; ++s)
        spheres.push_back({outermost.x + 1.3f, outermost.y + 0.3f * dice.symmetric(),
                           outermost.z + 0.3f * dice.symmetric(), 0.02f});
      const Chain chain(spheres);
      const auto grid = StrategyRegistry::instance().make("Grid");
      std::uint64_t proved = 0;
      const reference::Verification v = reference::verify_by_certificate(*grid, chain, 1 << 20, proved);
      EXPECT_EQ(v.verdict, reference::Verdict::exact) << "seed " << seed << ": " << v.reason;
      EXPECT_EQ(proved, reference::find(chain).pair_count) << "seed " << seed;
    }
}

TEST(GridLevels, ReadEachRadiusWhereThatIsAsked) {
  const Chain equal(std::vector<Sphere>(100, Sphere{0, 0, 0, 1}));
  for (const auto& [name, once] : {std::pair("Grid", true), std::pair("Grid(radii=each)", false)}) {
    const auto grid = StrategyRegistry::instance().make(name);
    Collisions found;
    grid->build(equal);
    grid->find(equal, {}, found);
    bool told = false;
    for (const Decision& decision : grid->plan())
      if (decision.step == "radius of each sphere in cells") {
        told = true;
        EXPECT_EQ(decision.left_out, once) << name;
      }
    EXPECT_TRUE(told) << name;
  }
}

}  // namespace catena::properties
