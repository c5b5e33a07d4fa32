// What each scene that does not move promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catena/core/error.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/test_pairs.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

Chain chain_of(const std::string& spec) { return SceneRegistry::instance().open(spec)->frame(0); }

double distance(const Sphere& a, const Sphere& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

std::size_t pairs(const Chain& chain) {
  const auto touching = test::touching_pairs(chain.spheres());
  return static_cast<std::size_t>(
      std::ranges::count_if(touching, [&](const Pair& p) { return !chain.neighbours(p.i, p.j); }));
}

TEST(TouchingPairs, AreThoseFoundByTryingAll) {
  const Chain yarn = chain_of("yarn:n=2000,radius=3");
  std::vector<Pair> all;
  for (std::uint32_t i = 0; i < yarn.size(); ++i)
    for (std::uint32_t j = i + 1; j < yarn.size(); ++j)
      if (test::relative_excess(yarn[i], yarn[j]) <= 0) all.push_back({i, j});
  EXPECT_EQ(test::touching_pairs(yarn.spheres()), all);
}

TEST(Rod, IsStraightCentredAndFreeOfPairs) {
  const Chain rod = chain_of("rod:n=1001,align=axes");
  for (std::uint32_t i = 0; i < rod.size(); ++i)
    EXPECT_EQ(rod[i], (Sphere{static_cast<float>(1.6 * (i - 500.0)), 0, 0, 1}));
  EXPECT_EQ(pairs(rod), 0u);
  EXPECT_EQ(pairs(chain_of("rod")), 0u);
}

TEST(Coil, HasTheWidthPitchAndSpacingAsked) {
  const Chain coil = chain_of("coil:n=5000,align=axes,width=20,pitch=4");
  for (std::uint32_t i = 0; i < coil.size(); ++i) {
    EXPECT_NEAR(std::hypot(coil[i].x, coil[i].y), 20, 1e-4);
    EXPECT_NEAR(distance(coil[i], coil[std::max(i, 1u) - 1]), i > 0 ? 1.6 : 0, 1e-3);
  }
  const double turns = 4999 * 1.6 / std::hypot(40 * std::acos(-1.0), 4);
  EXPECT_NEAR(double{coil[4999].z} - coil[0].z, 4 * turns, 0.01);
  EXPECT_EQ(pairs(coil), 0u);
  EXPECT_EQ(pairs(chain_of("coil")), 0u);
  EXPECT_GT(pairs(chain_of("coil:pitch=1.5")), 10000u);
}

TEST(TorusKnot, IsOneClosedStrandOfEqualSteps) {
  for (const char* spec : {"torus_knot:n=1000", "torus_knot:n=1000,p=5,q=7", "torus_knot:n=50000,p=3,q=2"}) {
    const Chain knot = chain_of(spec);
    ASSERT_EQ(knot.strand_count(), 1u);
    EXPECT_EQ(knot.strands().closed[0], 1);
    EXPECT_TRUE(knot.neighbours(0, knot.size() - 1));
    for (std::uint32_t i = 0; i < knot.size(); ++i)
      ASSERT_NEAR(distance(knot[i], knot[(i + 1) % knot.size()]), 1.6, 0.02) << spec << " sphere " << i;
  }
  EXPECT_EQ(pairs(chain_of("torus_knot:n=1000")), 0u);
}

TEST(TorusKnot, RefusesSeveralStrands) { EXPECT_THROW(chain_of("torus_knot:p=2,q=4"), InputError); }

TEST(Yarn, HasAboutFivePairsASphere) {
  for (const char* spec : {"yarn:n=10000", "yarn:n=10000,seed=2", "yarn:n=10000,seed=3", "yarn:n=30000",
                           "yarn:n=100000", "yarn:n=150000,seed=7", "yarn:n=1000000"}) {
    const Chain yarn = chain_of(spec);
    const double density = static_cast<double>(pairs(yarn)) / yarn.size();
    EXPECT_GT(density, 4) << spec;
    EXPECT_LT(density, 6) << spec;
  }
}

TEST(Yarn, KeepsItsSpacingAndDependsOnItsSeed) {
  const Chain yarn = chain_of("yarn"), other = chain_of("yarn:seed=2");
  for (std::uint32_t i = 1; i < yarn.size(); ++i) ASSERT_NEAR(distance(yarn[i - 1], yarn[i]), 1.6, 1e-4);
  EXPECT_FALSE(std::ranges::equal(yarn.spheres(), other.spheres()));
}

TEST(Walk, ForgetsItsDirectionOverItsPersistence) {
  const auto cosine_over = [](const Chain& walk, std::uint32_t steps) {
    double sum = 0;
    for (std::uint32_t i = 0; i + steps + 1 < walk.size(); ++i) {
      const Sphere &a = walk[i], &b = walk[i + 1], &c = walk[i + steps], &d = walk[i + steps + 1];
      sum +=
          ((b.x - a.x) * (d.x - c.x) + (b.y - a.y) * (d.y - c.y) + (b.z - a.z) * (d.z - c.z)) / (1.6 * 1.6);
    }
    return sum / (walk.size() - steps - 1.0);
  };
  EXPECT_NEAR(cosine_over(chain_of("walk:n=100000,persistence=80"), 50), std::exp(-1.0), 0.08);
  EXPECT_FALSE(std::ranges::equal(chain_of("walk").spheres(), chain_of("walk:seed=2").spheres()));
}

TEST(Hair, SharesItsSpheresOutToItsStrands) {
  const Chain hair = chain_of("hair:n=1003,strands=20");
  ASSERT_EQ(hair.strand_count(), 20u);
  for (std::uint32_t s = 0; s < 20; ++s) {
    const std::uint32_t first = hair.strands().first[s], last = hair.strands().first[s + 1];
    EXPECT_NEAR(last - first, 50.15, 1);
    for (std::uint32_t i = first + 1; i < last; ++i) ASSERT_NEAR(distance(hair[i - 1], hair[i]), 1.6, 1e-4);
  }
  // Where there are fewer spheres than strands, some have none, and each of the others begins at its own
  // root.
  const Chain few = chain_of("hair:n=5,strands=20,align=axes"),
              roots = chain_of("hair:n=20,strands=20,align=axes");
  ASSERT_EQ(few.strand_count(), 20u);
  for (std::uint32_t s = 0; s < 20; ++s)
    for (std::uint32_t i = few.strands().first[s]; i < few.strands().first[s + 1]; ++i) {
      EXPECT_EQ(few[i].x, roots[s].x);
      EXPECT_EQ(few[i].y, roots[s].y);
    }
  EXPECT_GT(pairs(chain_of("hair")), 1000u) << "strands touch each other";
}

TEST(CirclePoint, AgreesWithTheMathLibrary) {
  for (int k = -5000; k <= 5000; ++k) {
    const double turns = k / 977.0;
    const long double angle = 2 * std::acos(-1.0L) * static_cast<long double>(turns);
    EXPECT_NEAR(circle_point(turns).cosine, static_cast<double>(std::cos(angle)), 4e-16);
    EXPECT_NEAR(circle_point(turns).sine, static_cast<double>(std::sin(angle)), 4e-16);
  }
  EXPECT_EQ(circle_point(0.25).cosine, 0);
  EXPECT_EQ(circle_point(-0.25).sine, -1);
}

}  // namespace
}  // namespace catena
