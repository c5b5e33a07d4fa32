// Tubes of which every figure is known: what just touches, what bends, and where a closed one begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catena/bench/tube/arc_length.h"
#include "catena/bench/tube/contacts.h"
#include "catena/bench/tube/error.h"
#include "catena/bench/tube/tube.h"

namespace catena::bench {
namespace {

constexpr double pi = std::numbers::pi;

/// Two straight halves, side by side at the distance of two radii: each sphere touches one of the other half
/// exactly. How they are joined is nobody's concern.
Tube folded() {
  return {"folded", 40, 1, false, [](double s) { return s <= 20 ? Vec3{s, 0, 0} : Vec3{41 - s, 2, 0}; }};
}

TEST(TubeError, DoesNotMissWhatJustTouches) {
  const Tube tube = folded();
  const std::vector<Approach> all{{10, 31, 2, {}}};
  const TubeError error = tube_error(tube, all, 41);
  EXPECT_EQ(error.contacts, 1u);
  EXPECT_EQ(error.missed, 0u);
  EXPECT_EQ(error.missed_by_covering, 0u);
  EXPECT_EQ(error.invented, 0u);
}

TEST(Storage, FlipsNothingThatIsStoredAsItIs) {
  const StorageError error = storage_error(folded(), 41);
  EXPECT_GT(error.pairs, 10u);
  EXPECT_EQ(error.flips, 0u);
  EXPECT_EQ(error.least_margin, 0);
}

/// Half way between two spheres the tube of a ring of radius R reaches out to R + r.
TEST(TubeError, HasTheGapOfARing) {
  for (const double ring : {3.0, 10.0})
    for (const std::uint32_t n : {16u, 50u, 400u}) {
      const Tube tube{"ring", 2 * pi * ring, 1, true, [ring](double s) {
                        return Vec3{ring * std::cos(s / ring), ring * std::sin(s / ring), 0};
                      }};
      const double outer = ring + 1, half = pi / n,
                   gap = std::hypot(outer - ring * std::cos(half), ring * std::sin(half)) - 1;
      EXPECT_NEAR(tube_error(tube, {}, n).gap / gap, 1, 1e-9) << ring << ' ' << n;
    }
}

/// Where a closed tube begins is nothing of its shape: as many regions, as deep, whatever region its end
/// cuts.
TEST(Contacts, OfAClosedTubeAreTheSameWhereverItBegins) {
  const Tube curve = lissajous();
  const auto depths = [](const std::vector<Approach>& all) {
    std::vector<double> found;
    for (const Approach& a : all) found.push_back(a.distance);
    std::ranges::sort(found);
    return found;
  };
  const auto all = approaches(curve);
  const auto expected = depths(all);
  for (std::size_t k = 0; k < all.size(); k += 3)
    for (const double place : {all[k].s, all[k].t}) {
      Tube moved = curve;
      moved.position = [&, place](double s) { return curve.position(std::fmod(s + place, curve.length)); };
      const auto found = depths(approaches(moved));
      ASSERT_EQ(found.size(), expected.size()) << "from " << place << " on";
      for (std::size_t a = 0; a < found.size(); ++a) EXPECT_NEAR(found[a], expected[a], 1e-9) << place;
    }
}

TEST(ArcLength, FindsTheParameterOfEveryPlace) {
  const auto ellipse = [](double t) {
    return Vec3{-6 * pi * std::sin(2 * pi * t), 2 * pi * std::cos(2 * pi * t), 0};
  };
  const ArcLength coarse(ellipse, 64), fine(ellipse, 4096);
  ASSERT_NEAR(coarse.total(), fine.total(), 1e-9);
  for (int k = 0; k <= 500; ++k) {
    const double s = coarse.total() * k / 500;
    EXPECT_NEAR(coarse.parameter(s), fine.parameter(std::min(s, fine.total())), 1e-10) << k;
  }
  EXPECT_EQ(coarse.parameter(0), 0);
  EXPECT_NEAR(coarse.parameter(coarse.total() / 4), 0.25, 1e-10);
}

}  // namespace
}  // namespace catena::bench
