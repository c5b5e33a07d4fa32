#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/testing/pairs_found.h"
#include "catena/properties/testing/random_spheres.h"
#include "catena/reference/reference.h"
#include "catena/reference/verify.h"

// Cells as wide as four radii, of which a sphere looks into those that it reaches.
namespace catena::properties {
namespace {

/// Spheres on a lattice of half a cell, or a bit beside it, about a place: who reaches what, and into which
/// cell, is as near to changing as it can be.
Chain beside_borders(Dice& dice, std::uint32_t n, std::uint32_t side, float radius, float place, bool equal) {
  std::vector<Sphere> spheres;
  const auto at = [&] {
    const float v = place + radius * static_cast<float>(dice.below(side));
    return dice.one_in(3) ? std::nextafter(v, dice.one_in(2) ? INFINITY : -INFINITY) : v;
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const float x = at(), y = at(), z = at();
    spheres.push_back({x, y, z, equal ? radius : radius * (0.5f + 0.5f * dice.unit())});
  }
  return Chain(std::move(spheres), {{}, {}}, Exclusion::index(1 + dice.below(3)));
}

TEST(WideCells, FindWhatLiesAtTheirBorders) {
  std::uint64_t seed = 500, pairs = 0;
  for (const std::uint32_t n : {2u, 15u, 16u, 17u, 63u, 65u, 400u, 1500u})
    for (const std::uint32_t side : {3u, 12u, 30u})
      for (const float radius : {0.5f, 0.3f, 1e-30f, 1e20f})
        for (const float place : {0.0f, -7.0f, 3e6f}) {
          Dice dice(++seed);
          const Chain chain = beside_borders(dice, n, side, radius, place * radius, dice.one_in(2));
          const reference::Answer right = reference::find(chain);
          pairs += right.pair_count;
          ASSERT_TRUE(pairs_found("Grid(cells=wide)", chain) == right.pairs)
              << n << ' ' << side << ' ' << radius << ' ' << place;
        }
  EXPECT_GT(pairs, 100'000u);
}

TEST(WideCells, ProveWhatTheyFind) {
  std::uint64_t seed = 700;
  for (const std::uint32_t n : {16u, 17u, 300u})
    for (const std::uint32_t side : {4u, 10u, 40u})
      for (const float place : {0.0f, 1e5f}) {
        Dice dice(++seed);
        const Chain chain = beside_borders(dice, n, side, 0.5f, place, false);
        const auto grid = StrategyRegistry::instance().make("Grid(cells=wide)");
        std::uint64_t proved = 0;
        const reference::Verification v = reference::verify_by_certificate(*grid, chain, 1 << 20, proved);
        EXPECT_EQ(v.verdict, reference::Verdict::exact) << "seed " << seed << ": " << v.reason;
        EXPECT_EQ(proved, reference::find(chain).pair_count) << "seed " << seed;
      }
}

/// Points have cells of their own; so have spheres so far away that numbers lie more than a cell apart.
TEST(WideCells, FindPointsAndWhatIsFarAway) {
  for (const float radius : {0.0f, 1e-3f, 1.0f}) {
    Dice dice(9);
    std::vector<Sphere> spheres;
    for (int i = 0; i < 500; ++i) {
      const auto at = [&] { return 1e8f + 8 * static_cast<float>(dice.below(5)); };
      const float x = at(), y = at(), z = at();
      spheres.push_back({x, y, dice.one_in(2) ? z : -z, radius});
    }
    const Chain chain(std::move(spheres));
    const reference::Answer right = reference::find(chain);
    ASSERT_GT(right.pair_count, 100u);
    EXPECT_TRUE(pairs_found("Grid(cells=wide)", chain) == right.pairs) << radius;
  }
}

/// Cells are wide where little is near, as a look tells, and only for radii of one level.
TEST(WideCells, TakeFewerTestsWhereLittleIsNear) {
  const auto tests = [](const std::string& name, const Chain& chain) {
    const auto variant = StrategyRegistry::instance().make(name);
    Collisions found;
    variant->build(chain);
    variant->find(chain, {}, found);
    return variant->work().at(0).times;
  };
  const auto box = [](float volume) {
    std::mt19937 dice(3);
    return Chain(spheres_in_volume(20'000, volume, dice));
  };
  for (const float volume : {8.0f, 20.0f, 100.0f}) {
    const Chain chain = box(volume);
    EXPECT_EQ(tests("Grid", chain), tests("Grid(cells=wide)", chain)) << volume;
    EXPECT_LT(2 * tests("Grid", chain), tests("Grid(cells=narrow)", chain)) << volume;
  }
  const Chain crowded = box(0.7f);
  EXPECT_EQ(tests("Grid", crowded), tests("Grid(cells=narrow)", crowded));
}

}  // namespace
}  // namespace catena::properties
