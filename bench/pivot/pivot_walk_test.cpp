#include "catena/bench/pivot/pivot_walk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <vector>

#include "catena/bench/pivot/at_once.h"
#include "catena/bench/pivot/end_to_end.h"
#include "catena/core/blocks/simd_targets.h"
#include "catena/core/error.h"
#include "catena/properties/forced_target.h"
#include "catena/properties/suite.h"
#include "catena/reference/reference.h"
#include "hwy/highway.h"

namespace catena::bench {
namespace {

/// The move by its definition, on points, with a set that says whether the walk meets itself.
struct PlainWalk {
  std::vector<LatticePoint> points;

  bool attempt(std::span<const Pivot> pivots) {
    std::vector<LatticePoint> turned = points;
    for (const auto& [site, turn] : pivots)
      for (std::size_t p = site + 1; p < turned.size(); ++p)
        turned[p] = turned[site] + turn(turned[p] - turned[site]);
    if (std::set<LatticePoint>(turned.begin(), turned.end()).size() < turned.size()) return false;
    points = std::move(turned);
    return true;
  }
};

/// Its spheres, so thick that they collide.
Chain thick(const RotatedChain<>& chain) {
  std::vector<Sphere> spheres = chain.tree().spheres();
  for (Sphere& s : spheres) s.radius = 0.75f;
  return Chain(std::move(spheres));
}

void expect_the_same_as_plain(std::uint32_t n, std::size_t at_once, int moves, std::uint64_t seed) {
  PivotWalk walk(n);
  PlainWalk plain{walk.points()};
  Random random(seed);
  int accepted = 0;
  for (int k = 0; k < moves; ++k) {
    std::vector<Pivot> pivots;
    for (std::size_t p = 0; p < at_once; ++p) pivots.push_back(random_pivot(n, random));
    const bool made = plain.attempt(pivots);
    ASSERT_EQ(walk.attempt(pivots), made) << n << " points, move " << k;
    ASSERT_EQ(walk.end_to_end(), plain.points.back());
    accepted += made;
    if (k % 50 == 0) {
      ASSERT_EQ(walk.points(), plain.points) << n << " points, move " << k;
    }
  }
  EXPECT_EQ(walk.points(), plain.points);
  EXPECT_GT(accepted, 0);
}

TEST(PivotWalk, IsTheMoveByItsDefinition) {
  for (const std::uint32_t n : {2u, 3u, 4u, 7u, 8u, 9u, 15u, 16u, 17u, 33u, 100u, 257u})
    expect_the_same_as_plain(n, 1, 2000, n);
}

TEST(PivotWalk, IsTheMoveByItsDefinitionManyAtATime) {
  for (const std::uint32_t n : {9u, 40u, 200u})
    for (const std::size_t at_once : {2u, 3u, 8u}) expect_the_same_as_plain(n, at_once, 1000, n + at_once);
}

TEST(PivotWalk, IsAnOrdinaryChainThatTheExactReferenceJudges) {
  PivotWalk walk(5000);
  Random random(3);
  for (int round = 0; round < 5; ++round) {
    for (int k = 0; k < 2000; ++k) walk.attempt(random_pivot(walk.size(), random));
    EXPECT_EQ(reference::find(walk.chain(std::nextafter(0.5f, 0.0f))).pair_count, 0u);
    const auto chain = walk.chain(0.5f);
    EXPECT_GT(reference::find(chain).pair_count, 100u) << "a walk touches itself often";
  }
}

/// Every property of every variant, on what pivots make.
TEST(PivotWalk, IsJudgedByEveryVariantAfterAnyMoves) {
  std::vector<properties::Subject> subjects;
  for (properties::Subject& subject : properties::Subject::available())
    if (subject.exact()) subjects.push_back(std::move(subject));
  properties::Suite suite(std::move(subjects));
  PivotWalk walk(300);
  RotatedChain<> chain(300);
  Random random(6);
  for (int round = 0; round < 3; ++round) {
    for (int k = 0; k < 400; ++k) {
      walk.attempt(random_pivot(walk.size(), random));
      chain.attempt(random_rotation_pivot(chain.size(), random));
    }
    for (const Chain& state : {walk.chain(0.5f), chain.chain(), thick(chain)}) {
      const auto finding = suite.check_always(properties::Case::of(state));
      EXPECT_FALSE(finding) << finding->variant << ", " << finding->property << ": " << finding->what;
    }
  }
  EXPECT_GT(suite.variants().size(), 10u);
}

/// Machines differ in the best that they have.
TEST(PivotWalk, IsTheSameWithEveryInstructionSet) {
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
#if HWY_ARCH_X86  // on ARM NEON is all there is, and Highway counts it only beside AES
  EXPECT_GT(targets.size(), 1u);
#endif
  for (const std::int64_t target : targets) {
    const properties::ForcedTarget forced(target);
    for (const std::uint32_t n : {2u, 9u, 100u, 257u}) expect_the_same_as_plain(n, 1, 500, n);
    expect_the_same_as_plain(40, 3, 500, 1);
  }
}

/// Up to a pivot about every point, against the walk turned one point after the other.
TEST(AtOnce, AnswersAsARebuildDoes) {
  for (const std::uint32_t n : {2u, 3u, 100u, 1500u}) {
    PivotWalk walk(n);
    Random random(n);
    for (int k = 0; k < 1000; ++k) walk.attempt(random_pivot(n, random));
    const std::vector<AtOnce> all = measure_at_once(walk, 1e-3, random);
    EXPECT_EQ(all.back().pivots, n - 1);
    for (const AtOnce& seen : all) {
      EXPECT_TRUE(seen.agree) << seen.pivots << " of " << n;
      EXPECT_GT(seen.us_per_attempt * seen.rebuild_us, 0);
    }
  }
}

TEST(AtOnce, IsWrittenUnderItsKeys) {
  const AtOnce seen{.points = 9,
                    .pivots = 4,
                    .attempts = 7,
                    .acceptance = 0.5,
                    .us_per_attempt = 2,
                    .rebuild_us = 6,
                    .agree = false};
  EXPECT_EQ(to_json(seen).dump(),
            R"({"n":9,"pivots":4,"attempts":7,"acceptance":0.5,"us_per_attempt":2.0,"rebuild_us":6.0,)"
            R"("times":3.0,"agree":false})");
}

TEST(AtOnce, TurnsAWalkAsItsPivotsDo) {
  PivotWalk walk(40);
  Random random(9);
  int accepted = 0;
  for (int k = 0; k < 2000; ++k) {
    const Pivot one = random_pivot(20, random), other = random_pivot(20, random);
    const std::vector<Pivot> pivots{one, {other.site + 20 - 1, other.turn}};
    const auto right = turned(walk.points(), pivots);
    if (!walk.attempt(pivots)) continue;
    ++accepted;
    ASSERT_EQ(walk.points(), right);
  }
  EXPECT_GT(accepted, 20);
}

/// A walk of 10^7 points takes no more memory a point than one of 10^4, and says how much.
TEST(PivotWalk, TakesMemoryInProportion) {
  for (const std::uint32_t n : {10'000u, 1'000'000u, 10'000'000u}) {
    const PivotWalk walk(n);
    EXPECT_GE(walk.bytes(), 12.0 * n);
    EXPECT_LE(walk.bytes(), 20.0 * n + 1000);
  }
}

TEST(PivotWalk, RefusesWhatIsNoWalk) {
  EXPECT_THROW(PivotWalk(0), InputError);
  EXPECT_THROW(PivotWalk(1), InputError);
  EXPECT_THROW(PivotWalk((1u << 30) + 1), InputError);
}

TEST(LatticeSymmetry, IsAGroupOfFortyEight) {
  const LatticePoint p{1, 2, 3};
  std::set<LatticePoint> images;
  for (int k = 0; k < LatticeSymmetry::count; ++k) {
    const auto g = LatticeSymmetry::number(k);
    images.insert(g(p));
    EXPECT_EQ(g.after(g.inverse()), LatticeSymmetry());
    for (int l = 0; l < LatticeSymmetry::count; ++l) {
      const auto h = LatticeSymmetry::number(l);
      EXPECT_EQ(g.after(h)(p), g(h(p)));
    }
  }
  EXPECT_EQ(images.size(), 48u);
}

/// Short walks are all known: the mean square of the ends over all 30 walks of two steps is 2 2/5 (24 bent, 6
/// straight).
TEST(EndToEnd, IsThatOfAllWalksOfTwoSteps) {
  PivotWalk walk(3);
  Random random(4);
  const EndToEnd seen = measure_end_to_end(walk, 200'000, random);
  EXPECT_NEAR(seen.mean_square, (24 * 2 + 6 * 4) / 30.0, 5 * seen.error);
  EXPECT_LT(seen.error, 0.02);
}

/// A chain whose joints are still straight is longer than it should be: 40 runs of few moves from a straight
/// chain on, against one of many.
TEST(EndToEnd, IsNotThatOfAChainWhichIsStraightStill) {
  constexpr std::uint32_t n = 300;
  Random random(12);
  RotatedChain<> chain(n);
  const EndToEnd right = measure_end_to_end(chain, 200'000, random);
  constexpr int runs = 40;
  const auto mean_of_short_runs = [&](std::optional<std::uint64_t> warm_up) {
    double mean = 0, squares = 0;
    for (int k = 0; k < runs; ++k) {
      RotatedChain<> fresh(n);
      const EndToEnd seen = measure_end_to_end(fresh, 64, random, warm_up);
      EXPECT_EQ(seen.warm_up, warm_up.value_or(20 * n));
      mean += seen.mean_square / runs, squares += seen.mean_square * seen.mean_square / runs;
    }
    return std::pair(mean, std::sqrt((squares - mean * mean) / (runs - 1)));
  };
  const auto [mean, error] = mean_of_short_runs({});
  EXPECT_NEAR(mean, right.mean_square, 4 * (error + right.error));
  const auto [stiff, stiff_error] = mean_of_short_runs(n / 5);
  EXPECT_GT(stiff - 4 * stiff_error, 1.5 * right.mean_square);
}

TEST(EndToEnd, GivesTheExponentOfAPowerLaw) {
  std::vector<EndToEnd> lengths;
  for (std::uint32_t n = 101; n < 20'000; n *= 2) {
    const double steps = n - 1;
    const double mean = 1.2 * std::pow(steps, 2 * Exponent::published) * (1 - 0.1 * std::pow(steps, -0.528));
    lengths.push_back({.points = n, .attempts = 1, .mean_square = mean, .error = 1e-4 * mean});
  }
  EXPECT_NEAR(fit_exponent(lengths).nu, Exponent::published, 1e-4);
  EXPECT_TRUE(fit_exponent(lengths).agrees());
  for (const double side : {-1., 1.}) {  // give or take the error of what was published
    EXPECT_TRUE(
        (Exponent{Exponent::published + side * 1e-3, 1e-3 - 0.9 * Exponent::published_error}.agrees()));
    EXPECT_FALSE(
        (Exponent{Exponent::published + side * 1e-3, 1e-3 - 1.1 * Exponent::published_error}.agrees()));
  }
  for (EndToEnd& seen : lengths) seen.mean_square *= std::pow(seen.points, 0.01);
  EXPECT_FALSE(fit_exponent(lengths).agrees());
  EXPECT_THROW(fit_exponent(std::span(lengths).first(3)), InputError);
  lengths.front().error = 0;
  EXPECT_THROW(fit_exponent(lengths), InputError) << "walks of two points have one length";
}

template <class Walk = PivotWalk>
std::vector<EndToEnd> lengths_to(std::uint32_t most, std::uint64_t attempts) {
  std::vector<EndToEnd> lengths;
  Random random(5);
  for (std::uint32_t n = most / 32; n <= most; n *= 2) {
    Walk walk(n);
    lengths.push_back(measure_end_to_end(walk, attempts, random));
  }
  return lengths;
}

TEST(EndToEnd, HasThePublishedExponent) {
  const Exponent exponent = fit_exponent(lengths_to(4096, 50'000));
  EXPECT_TRUE(exponent.agrees()) << exponent.nu << " +- " << exponent.half_width;
  EXPECT_LT(exponent.half_width, 0.05);
}

/// Any rotation is of the same universality class.
TEST(EndToEnd, HasThePublishedExponentUnderAnyRotation) {
  const Exponent exponent = fit_exponent(lengths_to<RotatedChain<>>(2048, 30'000));
  EXPECT_TRUE(exponent.agrees()) << exponent.nu << " +- " << exponent.half_width;
  EXPECT_LT(exponent.half_width, 0.06);
}

TEST(EndToEndLong, HasThePublishedExponentUnderAnyRotation) {
  const Exponent exponent = fit_exponent(lengths_to<RotatedChain<>>(16384, 2'000'000));
  EXPECT_TRUE(exponent.agrees()) << exponent.nu << " +- " << exponent.half_width;
  EXPECT_LT(exponent.half_width, 0.008);
}

/// 10^8 points, from a straight walk on until binary32 holds its coordinates: minutes, and 10 GB with the
/// reference's.
TEST(EndToEndLong, WalksAHundredMillionPoints) {
  PivotWalk walk(100'000'000);
  EXPECT_LE(walk.bytes(), 20e8);
  Random random(8);
  std::uint64_t accepted = 0;
  for (int k = 0; k < 300'000; ++k) accepted += walk.attempt(random_pivot(walk.size(), random));
  EXPECT_GT(accepted, 30'000u);
  EXPECT_EQ(
      reference::find(walk.chain(std::nextafter(0.5f, 0.0f)), {.want = Request::Want::counts}).pair_count,
      0u);
}

TEST(EndToEndLong, HasThePublishedExponent) {
  const Exponent exponent = fit_exponent(lengths_to(65536, 20'000'000));
  EXPECT_TRUE(exponent.agrees()) << exponent.nu << " +- " << exponent.half_width;
  EXPECT_LT(exponent.half_width, 0.002);
}

}  // namespace
}  // namespace catena::bench
