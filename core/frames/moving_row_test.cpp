#include "catena/core/frames/moving_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "catena/core/arithmetic/exact_sign.h"
#include "catena/core/chain/chain.h"

namespace catena {
namespace {

/// At numbers of runs about those that bits of a vector can tell apart one by one.
TEST(MovingRow, FindsThePairsOfRunsThatChangedInRowsOfAnyLength) {
  std::mt19937 random(2);
  for (const std::uint32_t runs : {1u, 2u, 128u, 129u, 256u, 257u, 512u, 513u, 1024u, 1025u})
    for (const std::uint32_t left : {1u, 8u}) {
      const std::uint32_t n = 8 * (runs - 1) + left;
      std::vector<Sphere> spheres(n, Sphere{0, 0, 0, 1});
      MovingRow row;
      row.hold(spheres);
      const std::uint32_t some = random() % n;
      const std::vector<SphereRange> ranges{{some, some + 1}, {n - 1, n}};
      row.move(spheres, ranges);
      std::vector<Pair> pairs;
      for (std::uint32_t k = 0; k < 300; ++k) {
        const std::uint32_t i = random() % n, j = k % 20 == 0 ? n - 1 : random() % n;
        pairs.push_back({std::min(i, j), std::max(i, j)});
      }
      std::vector<std::uint32_t> found, right;
      row.find_changed(pairs, found);
      for (std::uint32_t k = 0; k < pairs.size(); ++k)
        for (const std::uint32_t run : {some / 8, (n - 1) / 8})
          if ((pairs[k].i / 8 == run || pairs[k].j / 8 == run) && (right.empty() || right.back() != k))
            right.push_back(k);
      EXPECT_EQ(found, right) << n;
    }
}

/// Spheres that touch within a unit of the last place, each alone with points in its run.
TEST(MovingRow, MeetsEveryTwoThatTouch) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.1f, 1);
  std::vector<Sphere> spheres;
  std::vector<SphereRange> ranges;
  std::vector<Pair> right;
  for (std::uint32_t k = 0; k < 300; ++k) {
    const auto y = 16 * static_cast<float>(k);
    const Sphere a{unit(random), y, 0, unit(random)};
    Sphere b{0, y, 0, unit(random)};
    b.x = std::nextafter(a.x + a.radius + b.radius, 9.0f);
    while (ExactSign::of_gap(a, b) > 0) b.x = std::nextafter(b.x, 0.0f);
    ranges.push_back({16 * k, 16 * k + 8});
    right.push_back({16 * k, 16 * k + 8});
    for (const Sphere& s : {a, b}) {
      spheres.push_back(s);
      spheres.insert(spheres.end(), 7, Sphere{s.x, y, 0, 0});
    }
  }
  const Chain chain(spheres, {}, Exclusion::index(7));  // the points of a run are neighbours of its sphere
  for (const bool by_cells : {false, true}) {
    MovingRow row;
    row.hold(spheres);
    row.move(spheres, ranges);
    std::vector<Pair> found;
    EXPECT_EQ(row.search(chain.view(), found, by_cells), by_cells);
    std::ranges::sort(found);
    EXPECT_TRUE(std::ranges::includes(found, right)) << by_cells;
  }
}

}  // namespace
}  // namespace catena
