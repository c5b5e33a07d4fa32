#include "catena/bench/tube/tube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// A straight piece beside a bend: the gap is that of the bend, whichever comes first.
TEST(TubeError, TellsTheGreatestGapAlongTheTube) {
  constexpr double bend = 4, piece = 8;
  const auto around = [](double s) {
    return Vec3{bend * std::sin(s / bend), bend * (1 - std::cos(s / bend)), 0};
  };
  const Vec3 end = around(piece), ahead{std::cos(piece / bend), std::sin(piece / bend), 0};
  const Tube arc{"arc", piece, 1, false, around};
  const Tube first{"first", 2 * piece, 1, false,
                   [=](double s) { return s < piece ? around(s) : end + (s - piece) * ahead; }};
  const Tube last{"last", 2 * piece, 1, false, [=](double s) { return first.position(2 * piece - s); }};
  const double gap = tube_error(arc, {}, 81).gap;
  EXPECT_GT(gap, 1.1 * tube_error(straight_rod(), {}, 401).gap);
  EXPECT_NEAR(tube_error(first, {}, 161).gap, gap, 1e-12);
  EXPECT_NEAR(tube_error(last, {}, 161).gap, gap, 1e-12);
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

/// The least distance of spheres that lie at most `reach` steps from these.
double nearest(const Tube& tube, double s, double t, double h, int reach) {
  const auto at = [&](double along) {
    return tube.position(tube.closed ? along - tube.length * std::floor(along / tube.length)
                                     : std::clamp(along, 0.0, tube.length));
  };
  double least = 1e300;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j) least = std::min(least, length(at(s + i * h) - at(t + j * h)));
  return least;
}

// Every number a second time, by its definition, at spacings that miss and invent some.
TEST(TubeError, IsWhatItsDefinitionsSay) {
  std::uint32_t missed = 0, invented = 0;
  for (const Tube& tube : {path1_tube(), lissajous(), torus_knot()}) {
    const auto all = approaches(tube);
    for (const double spacing : {0.9, 0.5, 0.31, 0.2, 0.09}) {
      const auto n = static_cast<std::uint32_t>(tube.length / spacing);
      const TubeError error = tube_error(tube, all, n);
      const double h = tube.length / (tube.closed ? n : n - 1);
      ASSERT_DOUBLE_EQ(error.spacing, h);
      EXPECT_DOUBLE_EQ(error.covering_radius, tube.radius + error.gap);
      EXPECT_DOUBLE_EQ(error.covering_depth_error, 2 * error.gap);
      TubeError expected;
      const Approach* deepest = nullptr;
      for (const Approach& a : all) {
        const double depth =
            2 * tube.radius - nearest(tube, h * std::round(a.s / h), h * std::round(a.t / h), h, 6);
        const bool touches = a.distance <= 2 * tube.radius, covered = depth + 2 * error.gap >= 0;
        expected.contacts += touches;
        expected.missed += touches && depth < 0;
        expected.missed_by_covering += touches && !covered;
        expected.invented += !touches && covered;
        if (touches && (deepest == nullptr || a.distance < deepest->distance)) deepest = &a;
      }
      EXPECT_EQ(error.contacts, expected.contacts) << tube.name << ' ' << n;
      EXPECT_EQ(error.missed, expected.missed) << tube.name << ' ' << n;
      EXPECT_EQ(error.missed_by_covering, expected.missed_by_covering) << tube.name << ' ' << n;
      EXPECT_EQ(error.invented, expected.invented) << tube.name << ' ' << n;
      missed += error.missed, invented += error.invented;
      double worst = 0;
      for (int i = 0; i < 16; ++i)
        worst =
            std::max(worst, nearest(tube, deepest->s + h * (i / 4) / 4, deepest->t + h * (i % 4) / 4, h, 1));
      EXPECT_NEAR(error.depth_error, worst - deepest->distance, 1e-9) << tube.name << ' ' << n;
    }
  }
  EXPECT_GT(missed, 0u);
  EXPECT_GT(invented, 0u);
}

// Of a closed tube the step around the end counts, too.
TEST(TubeError, LeavesOutOfTheVolumeWhatTwoSpheresLeaveOut) {
  for (const Tube& tube : {lissajous(), helix()})
    for (const std::uint32_t n : {800u, 1500u}) {
      const std::uint32_t steps = tube.closed ? n : n - 1;
      const double h = tube.length / steps;
      double out = 0;
      for (std::uint32_t k = 0; k < steps; ++k) {
        const double chord =
            length(tube.position(k * h) - tube.position(tube.closed && k + 1 == n ? 0 : (k + 1) * h));
        out += (h - chord + chord * chord * chord / 12) / h / steps;
      }
      EXPECT_NEAR(tube_error(tube, {}, n).volume_deficit / out, 1, 1e-7) << tube.name << ' ' << n;
    }
}

TEST_P(EveryTube, LosesAShareOfItsVolumeHoweverFewOrManySpheres) {
  double before = 1;
  for (std::uint32_t n = 8; n < 20'000'000; n += n / 2) {
    const double deficit = tube_error(tube, {}, n).volume_deficit;
    EXPECT_GE(deficit, 0) << n;
    EXPECT_LE(deficit, before) << n;
    before = deficit + 1e-9;  // rounding
  }
}

// Spheres of radius 1 that part fill 4/3 of each step, and from 2 on nothing jumps.
TEST(StraightRod, LosesWhatPartedSpheresLeave) {
  const auto deficit = [](double h) {
    return tube_error({"rod", 7 * h, 1, false, [](double s) { return Vec3{s, 0, 0}; }}, {}, 8).volume_deficit;
  };
  for (const double h : {2.0, 2.1, 3.0, 40.0 / 7, 1e6}) EXPECT_NEAR(deficit(h), 1 - 4 / (3 * h), 1e-9) << h;
  EXPECT_NEAR(deficit(2 - 1e-9), deficit(2 + 1e-9), 1e-8);
  EXPECT_NEAR(tube_error(straight_rod(), {}, 8).volume_deficit, 0.767, 5e-4);
}

TEST(Contacts, AreTheApproachesThatTouch) {
  const Tube rod = straight_rod();
  const std::vector<Approach> all{{1, 9, 2, {}}, {2, 9, 2 + 1e-12, {}}, {3, 9, 2 - 1e-12, {}}, {4, 9, 0, {}}};
  std::vector<double> touching;
  for (const Approach& a : contacts(rod, all)) touching.push_back(a.s);
  EXPECT_EQ(touching, (std::vector<double>{1, 3, 4}));
}

// By all pairs, far from the origin, where floats are so coarse that some distances are exactly the reach.
TEST(Storage, CountsByItsDefinition) {
  const Tube spring = helix(0.1);
  constexpr std::uint32_t n = 1200;
  constexpr double offset = 8e6;
  const StorageError error = storage_error(spring, n, offset);
  const double h = spring.length / (n - 1);
  std::vector<Vec3> real;
  std::vector<Sphere> spheres;
  double farthest = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    real.push_back(spring.position(std::min(i * h, spring.length)) + Vec3{offset, offset, offset});
    const Vec3& p = real.back();
    spheres.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 1});
    farthest = std::max(farthest, length(p - Vec3{spheres[i].x, spheres[i].y, spheres[i].z}));
  }
  EXPECT_EQ(stored_error(spring, n, offset), farthest);
  StorageError expected;
  expected.least_margin = 1e300;
  expected.decades.assign(10, 0);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 2; j < n; ++j) {
      if (spring.neighbours(i * h, j * h)) continue;
      const Sphere &a = spheres[i], &b = spheres[j];
      const Vec3 d{double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z}, r = real[i] - real[j];
      const double q = dot(d, d), margin = std::abs(q - 4) / 4;  // exact: few digits
      if (margin >= 1 && q > 4) continue;
      expected.pairs += q <= 4;
      expected.flips += (q <= 4) != (dot(r, r) <= 4);
      expected.least_margin = std::min(expected.least_margin, margin);
      int decade = 0;
      for (double bound = 0.1; decade < 9 && margin < bound; bound /= 10) ++decade;
      ++expected.decades[static_cast<std::size_t>(decade)];
    }
  EXPECT_GT(expected.decades[9], 0u);
  EXPECT_EQ(error.pairs, expected.pairs);
  EXPECT_EQ(error.flips, expected.flips);
  EXPECT_EQ(error.least_margin, expected.least_margin);
  EXPECT_EQ(error.decades, expected.decades);
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
