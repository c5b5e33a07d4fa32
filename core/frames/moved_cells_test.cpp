#include "catena/core/frames/moved_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/family.h"
#include "catena/properties/sorted_pairs.h"
#include "catena/reference/reference.h"

namespace catena {
namespace {

/// The pairs of any few spheres are those of the whole chain that have one of them.
TEST(MovedCells, FindThePairsOfAFew) {
  std::size_t laid_out = 0, pairs = 0;
  std::uint64_t seed = 900;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (const std::uint32_t size : {40u, 700u}) {
      properties::Dice dice(++seed);
      const Chain chain = properties::generate(family, dice, size);
      const std::uint32_t one_in = dice.pick({1u, 3u, 30u});
      std::vector<bool> is_moved(chain.size());
      std::vector<std::uint32_t> moved;
      for (std::uint32_t i = 0; i < chain.size(); ++i)
        if (dice.one_in(one_in)) is_moved[i] = true, moved.push_back(i);
      MovedCells cells;
      if (moved.empty() || !cells.lay_out(chain.view(), moved)) continue;
      ++laid_out;
      std::vector<Pair> found, right;
      cells.search(chain.view(), found);
      properties::sort(found);
      for (const Pair& p : reference::find(chain).pairs)
        if (is_moved[p.i] || is_moved[p.j]) right.push_back(p);
      EXPECT_EQ(found, right) << family.name << ", seed " << seed;
      pairs += right.size();
    }
  EXPECT_GT(laid_out, 20u);
  EXPECT_GT(pairs, 1000u);
}

/// Far from the origin boxes are wider than the spheres in them, by what rounding may lose: many cells each.
TEST(MovedCells, AreNotLaidOutWhereEachSphereWouldLieInVeryMany) {
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const auto at = static_cast<float>(i % 4);
    spheres.push_back({1e7f + at, 1e7f - at, 1e7f, 0.01f});
    all.push_back(i);
  }
  MovedCells cells;
  EXPECT_FALSE(cells.lay_out(Chain(spheres).view(), all));
  for (Sphere& s : spheres) s.x -= 1e7f, s.y -= 1e7f, s.z = 0;
  EXPECT_TRUE(cells.lay_out(Chain(spheres).view(), all));
}

/// A sphere whose centre is as far as both radii, a little more than their rounded sum, touches all the same.
TEST(MovedCells, ReachAsFarAsTwoRadiiAreLong) {
  struct Shown : MovedCells {
    using MovedCells::reach;
  } cells;
  properties::Dice dice(5);
  int rounded_down = 0;
  for (int k = 0; k < 2000; ++k) {
    const float radius = dice.unit(), greatest = 1 + dice.unit();
    EXPECT_GE(double{cells.reach({0, 0, 0, radius}, greatest)}, double{radius} + greatest);
    rounded_down += double{radius + greatest} < double{radius} + greatest;
  }
  EXPECT_GT(rounded_down, 100);
}

}  // namespace
}  // namespace catena
