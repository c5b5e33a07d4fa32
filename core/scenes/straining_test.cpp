// What each scene that strains something promises, in exact arithmetic where a tie decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/test_pairs.h"
#include "catena/core/scenes/torus_curve.h"

namespace catena {
namespace {

using Limits = std::numeric_limits<float>;

Chain chain_of(const std::string& spec) { return SceneRegistry::instance().open(spec)->frame(0); }

/// Contacts by trying all, for chains whose numbers strain every shortcut.
std::vector<Pair> contacts(const Chain& chain) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < chain.size(); ++i)
    for (std::uint32_t j = i + 1; j < chain.size(); ++j)
      if (!chain.neighbours(i, j) && Robust::overlap(chain[i], chain[j])) pairs.push_back({i, j});
  return pairs;
}

std::size_t exact_ties(const Chain& chain, const std::vector<Pair>& pairs) {
  return static_cast<std::size_t>(std::ranges::count_if(pairs, [&](const Pair& p) {
    return std::abs(test::relative_excess(chain[p.i], chain[p.j])) < 1e-18L;
  }));
}

double per_sphere(const std::string& spec) {
  const Chain chain = chain_of(spec);
  return static_cast<double>(contacts(chain).size()) / chain.size();
}

TEST(Slender, HasTheLengthAsked) {
  for (const double slenderness : {1e3, 1e6, 1e8}) {
    const Chain rod = chain_of("slender:n=2000,align=axes,slenderness=" + std::to_string(slenderness));
    EXPECT_NEAR((double{rod[1999].x} - rod[0].x) / slenderness, 1, 1e-3);
  }
  EXPECT_EQ(
      exact_ties(chain_of("slender:n=2000,align=axes"), contacts(chain_of("slender:n=2000,align=axes"))),
      1996u)
      << "the fourth neighbour touches exactly";
  EXPECT_EQ(contacts(chain_of("slender:n=2000,slenderness=1e6")).size(), 0u);
}

TEST(Grazing, HasOneContactASphereAtTheMarginAsked) {
  for (const double margin : {1e-2, 1e-4, 1e-5}) {
    const Chain coil = chain_of("grazing:n=1000,margin=" + std::to_string(margin));
    const auto pairs = contacts(coil);
    EXPECT_EQ(pairs.size(), 960u);
    for (const Pair& p : pairs) {
      EXPECT_EQ(p.j - p.i, 40u);
      EXPECT_NEAR(-static_cast<double>(test::relative_excess(coil[p.i], coil[p.j])), margin, 1e-5);
    }
  }
  EXPECT_EQ(contacts(chain_of("grazing:n=1000,margin=-1e-4")).size(), 0u);
  const std::size_t undecided = contacts(chain_of("grazing:n=1000,margin=0")).size();
  EXPECT_GT(undecided, 100u) << "rounding decides both ways";
  EXPECT_LT(undecided, 860u);
}

TEST(TightKnot, TouchesAtTheMarginAskedAndNowhereDeeper) {
  for (const char* spec : {"tight_knot:n=4000,p=2,margin=1e-3", "tight_knot:n=2000,p=0,margin=0.1"}) {
    const Chain knot = chain_of(spec);
    const auto pairs = contacts(knot);
    EXPECT_GT(pairs.size(), 10u) << spec;
    long double deepest = 0;
    for (const Pair& p : pairs) deepest = std::max(deepest, -test::relative_excess(knot[p.i], knot[p.j]));
    EXPECT_LT(deepest, 0.1001L) << spec;
  }
  EXPECT_EQ(contacts(chain_of("tight_knot:n=2000,p=2,margin=-1e-4")).size(), 0u);
}

TEST(TorusCurve, ClosestWindingsAreThoseFoundBySampling) {
  for (const TorusCurve knot : {TorusCurve{2, 3}, TorusCurve{5, 6}}) {
    constexpr int samples = 1500;
    double nearest = 10;
    std::vector<Vec3> points;
    for (int i = 0; i < samples; ++i) points.push_back(knot.position(static_cast<double>(i) / samples));
    const int window = static_cast<int>(samples / (1.5 * (knot.p + knot.q)));
    for (int i = 0; i < samples; ++i)
      for (int j = i + window; j < std::min(samples, samples + i - window); ++j)
        nearest = std::min(nearest,
                           length(points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)]));
    EXPECT_NEAR(knot.closest_windings(), nearest, 2e-3);
    EXPECT_LE(knot.closest_windings(), nearest + 1e-12);
  }
}

TEST(MixedRadii, SpanThirtyDecadesAndJumpASixthPowerOfTen) {
  const Chain horn = chain_of("mixed_radii:n=2000");
  EXPECT_NEAR(std::log10(double{horn[1998].radius} / horn[0].radius), 30, 0.2);
  for (std::uint32_t i = 0; i + 1 < horn.size(); i += 2)
    EXPECT_NEAR(std::log10(double{horn[i].radius} / horn[i + 1].radius), 6, 0.2);
  const double pairs = per_sphere("mixed_radii:n=2000");
  EXPECT_GT(pairs, 0.4);
  EXPECT_LT(pairs, 20);
}

TEST(Far, IsAsFarAsAskedAndBecomesALattice) {
  const Chain chain = chain_of("far:n=1000,exponent=24,align=axes");
  for (const Sphere& s : chain.spheres()) {
    EXPECT_NEAR(s.x, 0x1p24, 1000);
    EXPECT_EQ(s.x, std::floor(s.x));
  }
  EXPECT_GT(exact_ties(chain, contacts(chain)), 100u);
  EXPECT_GT(chain_of("far:n=1000,exponent=20,radius=1e24")[0].x, 1e29f);
}

TEST(FloatRange, IsAtItsEnds) {
  float greatest = 0;
  const Chain largest = chain_of("largest:n=1000");  // named: its spheres are a view into it
  for (const Sphere& s : largest.spheres())
    greatest = std::max({greatest, std::abs(s.x), std::abs(s.y), std::abs(s.z)});
  EXPECT_GT(greatest, Limits::max() / 16);
  EXPECT_EQ(chain_of("smallest:n=1000")[0].radius, Limits::min());
  EXPECT_EQ(chain_of("subnormal:n=1000")[0].radius, 4 * Limits::denorm_min());
  for (const char* name : {"largest", "smallest", "subnormal"})
    EXPECT_GT(contacts(chain_of(std::string(name) + ":n=1000")).size(), 100u) << name;
}

TEST(CoincidentAndNested, TouchAllOfTheirGroupAndNoOther) {
  const std::size_t in_group = 30 * 29 / 2 - 29;
  for (const char* spec : {"coincident:n=300", "nested:n=300"})
    for (const Pair& p : contacts(chain_of(spec))) EXPECT_EQ(p.i / 30, p.j / 30) << spec;
  EXPECT_EQ(contacts(chain_of("coincident:n=300")).size(), 10 * in_group);
  EXPECT_EQ(contacts(chain_of("nested:n=300")).size(), 10 * in_group);
  const Chain group = chain_of("nested:n=30");
  for (std::uint32_t i = 1; i < 30; ++i)
    EXPECT_EQ(group[i].x - group[i - 1].x, group[i].radius - group[i - 1].radius);
  EXPECT_EQ(contacts(chain_of("coincident:n=100,together=100")).size(), 100u * 99 / 2 - 99);
}

TEST(CollinearAndLattice, TouchExactlyAndOneUlpDecides) {
  const Chain line = chain_of("collinear:n=1000"), cube = chain_of("lattice:n=1000");
  EXPECT_EQ(contacts(line).size(), 998u);
  EXPECT_EQ(exact_ties(line, contacts(line)), 998u);
  EXPECT_EQ(contacts(cube).size(), 3u * 10 * 10 * 9 - 999);
  EXPECT_EQ(exact_ties(cube, contacts(cube)), 3u * 10 * 10 * 9 - 999);
  const std::size_t moved = contacts(chain_of("lattice_moved:n=1000")).size();
  EXPECT_GT(moved, 500u);
  EXPECT_LT(moved, 1600u) << "some contacts are lost to the ulp";
}

/// Whole points in the least cube that has room, of spheres that touch exactly so many steps apart.
TEST(Serpentine, FillsTheLeastCubeWithSpheresThatReachAsFarAsAsked) {
  for (const std::uint32_t reach : {1u, 2u, 3u, 5u})
    for (const std::uint32_t side : {3u, 6u}) {
      const Chain cube = chain_of("serpentine:n=" + std::to_string(side * side * side - 1) +
                                  ",reach=" + std::to_string(reach));
      std::size_t pairs = 0, ties = 0;
      const auto most = static_cast<int>(side) - 1, far = static_cast<int>(reach);
      for (int x = -most; x <= most; ++x)
        for (int y = -most; y <= most; ++y)
          for (int z = -most; z <= most; ++z) {  // so many places has such a step, seen from both ends
            const auto places = static_cast<std::size_t>((most + 1 - std::abs(x)) * (most + 1 - std::abs(y)) *
                                                         (most + 1 - std::abs(z)));
            const int square = x * x + y * y + z * z;
            pairs += square > 0 && square <= far * far ? places : 0;
            ties += square == far * far ? places : 0;
          }
      const Chain whole =
          chain_of("serpentine:side=" + std::to_string(side) + ",reach=" + std::to_string(reach));
      ASSERT_EQ(whole.size(), side * side * side);
      EXPECT_TRUE(std::ranges::equal(cube.spheres(), whole.spheres().first(cube.size())));
      const auto found = contacts(whole);
      const std::size_t neighbours = whole.size() - 1;  // one step apart, which touch exactly at a reach of 1
      EXPECT_EQ(found.size(), pairs / 2 - neighbours) << side << ' ' << reach;
      EXPECT_EQ(exact_ties(whole, found), ties / 2 - (reach == 1 ? neighbours : 0)) << side << ' ' << reach;
    }
}

TEST(LatticeMoved, MovesByAsManyUlpsAsAskedAtMost) {
  const Chain cube = chain_of("lattice:n=1000");
  for (const int ulps : {1, 2, 5}) {
    const Chain moved = chain_of("lattice_moved:n=1000,ulps=" + std::to_string(ulps));
    int greatest = 0;
    for (std::uint32_t i = 0; i < cube.size(); ++i)
      for (const float Sphere::*axis : {&Sphere::x, &Sphere::y, &Sphere::z}) {
        const float from = cube[i].*axis, to = moved[i].*axis;
        if (from == 0) {
          EXPECT_EQ(to, 0);
        }
        int steps = 0;
        for (float v = from; v != to && steps <= ulps; v = std::nextafter(v, to)) ++steps;
        greatest = std::max(greatest, steps);
      }
    EXPECT_EQ(greatest, ulps);
  }
}

TEST(Points, TouchExactlyAndPointsOnlyTheirEqual) {
  const Chain chain = chain_of("points:n=1000");
  bool equal_points = false;
  for (const Pair& p : contacts(chain))
    if (chain[p.i].radius == 0 && chain[p.j].radius == 0) {
      EXPECT_EQ(chain[p.i], chain[p.j]);
      equal_points = true;
    }
  EXPECT_TRUE(equal_points);
}

TEST(Stretched, HasGapsAndHeaps) {
  const Chain chain = chain_of("stretched:n=2000");
  double nearest = 1e9, farthest = 0;
  for (std::uint32_t i = 1; i < chain.size(); ++i) {
    const double d = std::hypot(double{chain[i].x} - chain[i - 1].x, double{chain[i].y} - chain[i - 1].y,
                                double{chain[i].z} - chain[i - 1].z);
    nearest = std::min(nearest, d), farthest = std::max(farthest, d);
  }
  EXPECT_LT(nearest, 0.3);
  EXPECT_GT(farthest, 10);
}

TEST(Winding, HasTheContactsAskedWhateverN) {
  EXPECT_NEAR(2 * per_sphere("winding:n=4000,contacts=100"), 100, 35);
  EXPECT_NEAR(2 * per_sphere("winding:n=2000,contacts=20"), 20, 7);
}

TEST(Cluster, IsCoveredByItsFirstSphereAndHasFewOtherPairs) {
  const Chain chain = chain_of("cluster:n=2000");
  const auto pairs = contacts(chain);
  const auto of_cover = std::ranges::count_if(pairs, [](const Pair& p) { return p.i == 0; });
  EXPECT_EQ(of_cover, 1998);
  EXPECT_LT(pairs.size(), 6000u);
  EXPECT_LT(std::hypot(chain[1999].x, chain[1999].y, chain[1999].z), 1e-29);
}

TEST(StrainingScenes, KeepTheirPairsBoundedAtTheirDefaults) {
  for (const SceneInfo& info : SceneRegistry::instance().scenes())
    EXPECT_TRUE(info.strains.empty() || per_sphere(info.name + ":n=2000") < 200) << info.name;
}

}  // namespace
}  // namespace catena
