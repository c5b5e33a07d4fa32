#include "catena/core/space_tree/search_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/scattered.h"
#include "catena/core/space_tree/mean_near.h"
#include "catena/properties/forced_target.h"
#include "catena/properties/generators/dice.h"

namespace catena {
namespace {

/// To and fro through a cubic lattice of step 1 with so many points along two of its axes.
std::vector<Sphere> rows(std::uint32_t n, std::uint32_t side, float radius) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t row = i / side, x = i % side, layer = row / side, y = row % side;
    spheres.push_back({static_cast<float>(row % 2 == 0 ? x : side - 1 - x),
                       static_cast<float>(layer % 2 == 0 ? y : side - 1 - y), static_cast<float>(layer),
                       radius});
  }
  return spheres;
}

std::vector<Sphere> anywhere(std::uint32_t n, float room, const std::function<float(std::uint32_t)>& radius) {
  properties::Dice dice(5);
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i)
    spheres.push_back({room * dice.symmetric(), room * dice.symmetric(), room * dice.symmetric(), radius(i)});
  return spheres;
}

TEST(SearchCost, SpheresThatAreNearAreToldByAPartWhateverPeriodsTheChainHas) {
  for (std::uint32_t side = 18; side <= 54; side += 3)
    for (const float radius : {0.5f, 1.3f}) {
      const Chain chain(rows(27000, side, radius));
      std::vector<std::uint32_t> samples(most_samples);
      for (std::uint32_t k = 0; k < samples.size(); ++k) samples[k] = 840 * k + scattered(k, 840);
      const NearSpheres all = mean_near(chain.view(), samples, radius, 1),
                        part = mean_near(chain.view(), samples, radius, 9);
      EXPECT_NEAR(part.by_reach / all.by_reach, 1, 0.35) << side << ' ' << radius;
      EXPECT_NEAR(part.in_cells / all.in_cells, 1, 0.35) << side << ' ' << radius;
    }
}

TEST(SearchCost, SpheresThatAreNearAreThoseOfTheLattice) {
  const Chain chain(rows(27000, 30, 0.5f));
  const std::vector<std::uint32_t> middle{15 * 900 + 15 * 30 + 15};
  const NearSpheres near = mean_near(chain.view(), middle, 0.5f, 1);
  EXPECT_EQ(near.by_reach, 3.375 * 27 / 2.0) << "boxes that touch meet";
  EXPECT_EQ(near.in_cells, 27 / 2.0);
  EXPECT_EQ(mean_near(chain.view(), middle, 1.0f, 1).in_cells, 216 / 2.0) << "cells of eight";
  EXPECT_EQ(mean_near(Chain(rows(27000, 30, 0.49f)).view(), middle, 0.5f, 1).by_reach, 3.375 / 2)
      << "boxes apart";
}

TEST(SearchCost, ScatteredNumbersLieEvenly) {
  for (const std::uint32_t end : {1u, 2u, 7u, 128u, 1000u}) {
    std::vector<std::uint32_t> times(end);
    for (std::uint32_t k = 0; k < 100 * end; ++k) ++times.at(scattered(k, end));
    const auto [least, most] = std::minmax_element(times.begin(), times.end());
    EXPECT_GE(*least, 97u) << end;
    EXPECT_LE(*most, 103u) << end;
  }
}

/// Cells have one width: for radii of about the same size, whether or not some are exactly the greatest, or
/// where the smaller ones are few in each.
TEST(SearchCost, CellsAreForRadiiThatFitOneWidth) {
  const auto in_cells = [](float room, const std::function<float(std::uint32_t)>& radius) {
    const Chain chain(anywhere(20000, room, radius));
    return single_spheres(chain.view()).in_cells;
  };
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    const float crowded = wide_vectors() ? 6 : 7.2f, loose = 14;  // others leave cells sooner
    EXPECT_TRUE(in_cells(crowded, [](std::uint32_t) { return 0.5f; })) << target;
    EXPECT_TRUE(in_cells(crowded, [](std::uint32_t i) { return i % 2 == 0 ? 0.5f : 0.45f; })) << target;
    EXPECT_TRUE(in_cells(loose, [](std::uint32_t i) { return i % 2 == 0 ? 0.5f : 0.05f; })) << target;
    EXPECT_FALSE(in_cells(crowded, [](std::uint32_t i) { return i % 2 == 0 ? 0.5f : 0.05f; })) << target;
    EXPECT_TRUE(in_cells(crowded, [](std::uint32_t i) { return i % 200 == 0 ? 0.05f : 0.5f; })) << target;
  }
}

/// Points have no width that cells could be as wide as.
TEST(SearchCost, PointsAreInTheOrderOfSpace) {
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    for (const std::uint32_t n : {300u, 3000u, 30000u})
      for (const float room : {0.0f, 5.0f, 40.0f}) {
        const auto in_cells = [&](float radius) {
          return single_spheres(Chain(anywhere(n, room, [&](std::uint32_t) { return radius; })).view())
              .in_cells;
        };
        EXPECT_FALSE(in_cells(0)) << n << ' ' << room << ' ' << target;
      }
  }
}

/// So many spheres in as many cells each, whatever their number, of radii from 1/2 to so many times less.
bool in_cells_of(std::uint32_t n, double near, float ratio) {
  const auto room = static_cast<float>(std::cbrt(n * 27 / 16.0 / near));
  properties::Dice dice(9);
  const auto radius = [&](std::uint32_t) { return 0.5f * std::pow(ratio, -dice.unit()); };
  return single_spheres(Chain(anywhere(n, room, radius)).view()).in_cells;
}

TEST(SearchCost, FewSpheresAreInTheOrderOfSpaceWhereManyAreInCells) {
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    EXPECT_FALSE(in_cells_of(3000, 600, 1)) << target;
    EXPECT_TRUE(in_cells_of(30000, wide_vectors() ? 150 : 100, 1)) << target;
    // Of 3,000 it is about even where vectors hold eight spheres.
    EXPECT_TRUE(in_cells_of(30000, 4, 1)) << target;
    for (const std::uint32_t n : {3000u, 30000u})
      for (const double near : {1.0, 30.0})
        EXPECT_TRUE(in_cells_of(n, near, 1)) << n << ' ' << near << ' ' << target;
  }
}

TEST(SearchCost, RadiiOfManyOctavesAreInCellsWhereMuchIsBesideThem) {
  for (const std::int64_t target : properties::targets_here()) {
    const properties::ForcedTarget forced(target);
    EXPECT_TRUE(in_cells_of(30000, 26, 10)) << target;
    EXPECT_FALSE(in_cells_of(30000, 80, 10)) << "too much for one width, " << target;
  }
}

TEST(SearchCost, OctavesCostWhereCellsHaveWhatIsNotWithinReach) {
  const auto in_space = [](double by_reach, double in_cells, double bits) {
    return SingleSphereCost::in_space({by_reach, in_cells}, bits, 1000);
  };
  EXPECT_EQ(in_space(4, 100, 0), in_space(4, 4, 0)) << "one octave";
  EXPECT_EQ(in_space(4, 16, 2), in_space(4, 4, 0)) << "little beside";
  EXPECT_GT(in_space(4, 20, 2), in_space(4, 16, 2));
  EXPECT_GT(in_space(4, 20, 3), in_space(4, 20, 2));
}

TEST(SearchCost, ATreeOfFewerSpheresIsCheaperByDegrees) {
  EXPECT_EQ(shallow_share(20'000), 1);
  EXPECT_EQ(shallow_share(1'000'000'000), 1);
  EXPECT_EQ(shallow_share(0), shallow_share(1));
  EXPECT_GT(shallow_share(0), 0.5);
  for (std::uint32_t n = 2; n < 100'000; n += 1 + n / 10) {
    EXPECT_GE(shallow_share(n), shallow_share(n - 1)) << n;
    EXPECT_LT(shallow_share(n), 1.09 * shallow_share(n - n / 2)) << n;
  }
}

}  // namespace
}  // namespace catena
