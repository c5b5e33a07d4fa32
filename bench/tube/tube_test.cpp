#include "catena/bench/tube/tube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "catena/bench/tube/contacts.h"
#include "catena/bench/tube/error.h"

namespace catena::bench {
namespace {

class EveryTube : public testing::TestWithParam<std::string> {
 protected:
  const Tube tube = tubes_named({GetParam()}).front();
};
INSTANTIATE_TEST_SUITE_P(Known, EveryTube, testing::ValuesIn(known_tubes()),
                         [](const auto& test) { return test.param; });

TEST_P(EveryTube, IsTravelledAtUnitSpeedAndBendsLessThanItIsThick) {
  EXPECT_EQ(tube.name, GetParam());
  constexpr double h = 1e-3;
  for (int k = 1; k < 8000; ++k) {
    const double s = tube.length * k / 8000;
    const Vec3 before = tube.position(s - h), here = tube.position(s), after = tube.position(s + h);
    EXPECT_NEAR(length(after - before) / (2 * h), 1, 1e-5);
    EXPECT_LT(length(after + before - 2.0 * here) / (h * h) * tube.radius, 1) << "curvature at " << s;
  }
  EXPECT_TRUE(!tube.closed || length(tube.position(0) - tube.position(tube.length)) < 1e-9);
}

/// The tube error at spacings from 1 down over three decades.
std::vector<TubeError> sweep(const Tube& tube) {
  const auto all = approaches(tube);
  std::vector<TubeError> errors;
  for (double h = 1; h > 0.9e-3; h /= 10)
    errors.push_back(tube_error(tube, all, static_cast<std::uint32_t>(std::ceil(tube.length / h)) + 1));
  return errors;
}

double slope(const std::vector<TubeError>& errors, double TubeError::*what) {
  const TubeError &first = errors.front(), &last = errors.back();
  return std::log(first.*what / (last.*what)) / std::log(first.spacing / last.spacing);
}

TEST_P(EveryTube, HasErrorsOfOrderTwoOverThreeDecades) {
  const auto errors = sweep(tube);
  EXPECT_GT(errors.front().spacing / errors.back().spacing, 900);
  EXPECT_NEAR(slope(errors, &TubeError::gap), 2, 0.1);
  EXPECT_NEAR(slope(errors, &TubeError::volume_deficit), 2, 0.1);
  if (errors.front().contacts > 0) {
    EXPECT_NEAR(slope(errors, &TubeError::depth_error), 2, 0.1);
    EXPECT_NEAR(slope(errors, &TubeError::covering_depth_error), 2, 0.1);
  }
}

TEST_P(EveryTube, CoveringSpheresMissNothingAndFineChainsFindEveryContact) {
  const auto errors = sweep(tube);
  for (const TubeError& error : errors) EXPECT_EQ(error.missed_by_covering, 0u) << error.n;
  EXPECT_EQ(errors.back().missed, 0u);
  EXPECT_EQ(errors.back().invented, 0u);
}

TEST(StraightRod, HasTheErrorsThatGeometryGives) {
  const Tube rod = straight_rod();
  EXPECT_TRUE(approaches(rod).empty());
  for (const std::uint32_t n : {41u, 401u, 4001u}) {
    const TubeError error = tube_error(rod, {}, n);
    const double h = error.spacing;
    EXPECT_NEAR(error.gap / (std::sqrt(1 + h * h / 4) - 1), 1, 1e-6);
    EXPECT_NEAR(error.volume_deficit / (h * h / 12), 1, 1e-6);
  }
}

TEST(Contacts, OfAHelixAreOneRegionAsDeepAsAsked) {
  for (const double depth : {0.1, 1e-5}) {
    const Tube spring = helix(depth);
    const auto touching = contacts(spring, approaches(spring));
    ASSERT_EQ(touching.size(), 1u);
    EXPECT_NEAR(touching[0].depth(spring.radius), depth, 1e-12);
    EXPECT_GT(touching[0].rows.size(), 2000u) << "all along";
  }
}

TEST(Contacts, OfAKnotAreAsDeepAsAsked) {
  const Tube knot = torus_knot(2, 0.1);
  const auto touching = contacts(knot, approaches(knot));
  ASSERT_FALSE(touching.empty());
  const auto deepest = std::ranges::min_element(touching, {}, &Approach::distance);
  EXPECT_NEAR(deepest->depth(knot.radius), 0.1, 1e-6);
}

TEST(Contacts, OfThePathsAreTheirNineCrossingsAsDeepAsTheyWereRaised) {
  for (const Tube& path : {path1_tube(), path2_tube()}) {
    auto all = approaches(path);
    std::ranges::sort(all, {}, &Approach::distance);
    const std::vector depths{0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 1e-3, -1e-3, -0.02};
    ASSERT_EQ(all.size(), depths.size()) << path.name;
    for (std::size_t k = 0; k < depths.size(); ++k)
      EXPECT_NEAR(all[k].depth(path.radius), depths[k], 1e-12) << path.name << ' ' << k;
  }
}

TEST(Contacts, OfCrossingsAreSomeDeepSomeShallowAndSomeNot) {
  const Tube curve = lissajous();
  const auto all = approaches(curve);
  const auto touching = contacts(curve, all);
  EXPECT_GT(touching.size(), 3u);
  EXPECT_GT(all.size(), touching.size());
  for (const Approach& a : all) {  // nothing nearer around
    const auto distance = [&](double s, double t) { return length(curve.position(s) - curve.position(t)); };
    for (const double e : {-1e-4, 1e-4}) {
      EXPECT_GE(distance(a.s + e, a.t), a.distance - 1e-12);
      EXPECT_GE(distance(a.s, a.t + e), a.distance - 1e-12);
    }
  }
}

TEST(Storage, FlipsMoreTheFartherTheChainLies) {
  const Tube spring = helix(0.1);
  const StorageError near = storage_error(spring, 4000), far = storage_error(spring, 4000, 1e6);
  EXPECT_GT(near.pairs, 1000u);
  EXPECT_LE(near.flips, 2u);
  EXPECT_GT(far.flips, 20u);
  EXPECT_GT(near.least_margin, 0);
  EXPECT_LT(near.least_margin, 1e-2);
}

TEST(TubeError, AToleranceTakesNoMoreSpheresThanItMust) {
  for (const Tube& tube : {straight_rod(), helix(), lissajous()})
    for (const double tolerance : {0.3, 0.01, 1e-4}) {
      const std::uint32_t n = spheres_for(tube, tolerance);
      ASSERT_GT(n, 8u) << tube.name;
      EXPECT_LE(tube_error(tube, {}, n).gap, tolerance * tube.radius) << tube.name;
      EXPECT_GT(tube_error(tube, {}, n - 1).gap, tolerance * tube.radius) << tube.name;
    }
}

}  // namespace
}  // namespace catena::bench
