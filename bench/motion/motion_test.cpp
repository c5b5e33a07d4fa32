#include "catena/bench/motion/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "catena/bench/motion/knot_determinant.h"
#include "catena/bench/motion/report.h"
#include "catena/core/motion/knot.h"
#include "catena/core/motion/rope.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

std::vector<Vec3> mapped(std::vector<Vec3> points, Vec3 (*map)(const Vec3&)) {
  for (Vec3& p : points) p = map(p);
  return points;
}

TEST(KnotDeterminant, TellsKnotsApartHoweverTheyLie) {
  const auto knot = motion::overhand_knot(100, 1);
  EXPECT_EQ(knot_determinant(knot), 3u);
  EXPECT_EQ(knot_determinant(mapped(knot, [](const Vec3& p) { return Vec3{p.x, p.z, -p.y}; })), 3u);
  EXPECT_EQ(knot_determinant(mapped(knot,
                                    [](const Vec3& p) {
                                      return Vec3{p.x, p.y, -p.z};
                                    })),
            3u)
      << "mirrored";
  EXPECT_EQ(knot_determinant(mapped(knot,
                                    [](const Vec3& p) {
                                      return Vec3{p.x, 0.5 * p.y + p.x, 3 * p.z};
                                    })),
            3u);
  std::vector<Vec3> two = knot;
  for (const Vec3& p : knot) two.push_back(p + Vec3{100, 3, 1});
  EXPECT_EQ(knot_determinant(two), 9u);
  EXPECT_EQ(knot_determinant(mapped(knot,
                                    [](const Vec3& p) {
                                      return Vec3{p.x, p.y, 0.01 * p.z};
                                    })),
            3u)
      << "flat";
}

TEST(KnotDeterminant, IsOneWithoutAKnotWhateverCrosses) {
  EXPECT_EQ(knot_determinant({}), 1u);
  const std::vector<Vec3> straight{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(knot_determinant(straight), 1u);
  std::vector<Vec3> coil;  // crosses itself in every picture, and falls apart when pulled
  for (int k = 0; k < 200; ++k) coil.push_back({0.05 * k, 5 * std::cos(0.3 * k), 5 * std::sin(0.3 * k)});
  EXPECT_EQ(knot_determinant(coil), 1u);
  EXPECT_NE(knot_determinant(motion::overhand_knot(motion::least_knot, 1)), 1u);
  for (std::uint32_t n = 2; n < motion::least_knot; ++n)
    EXPECT_EQ(knot_determinant(motion::overhand_knot(n, 1)), 1u) << n << ": too short for the knot";
}

TEST(FrameComparison, CountsContactsThatAreNowhereNear) {
  const std::vector<std::vector<Pair>> fine{{{1, 10}, {20, 40}}, {{5, 50}}};
  const std::vector<std::vector<Pair>> near{{{3, 8}, {20, 43}}, {{7, 52}}}, cut{{{1, 10}}};
  EXPECT_EQ(compare_frames(fine, fine).missed, 0u);
  EXPECT_EQ(compare_frames(fine, near).missed, 1u) << "(20, 43) is 3 away";
  EXPECT_EQ(compare_frames(fine, cut).missed, 2u) << "a frame not reached has no contacts";
  EXPECT_EQ(compare_frames(fine, cut).contacts, 3u);
  constexpr std::uint32_t far = FrameComparison::near_along;
  EXPECT_EQ(compare_frames({{{10, 100}}}, {{{10 + far, 100}}}).missed, 0u);
  EXPECT_EQ(compare_frames({{{10, 100}}}, {{{10, 100 - far}}}).missed, 0u);
  EXPECT_EQ(compare_frames({{{10, 100}}}, {{{11 + far, 100}}}).missed, 1u);
}

MotionCase small(const std::string& variant, double step, double offset = 0) {
  return {1e4, step, offset, variant, 80, 13, 60};
}

TEST(Motion, HoldsAtAFineStepSlipsAtACoarseOneAndExactVariantsMissNothing) {
  const MotionResult fine = measure_motion(small("aCPU2+CPU2", 0.25)),
                     coarse = measure_motion(small("aCPU2+CPU2", 2.5));
  EXPECT_EQ(fine.outcome, MotionOutcome::holds);
  EXPECT_EQ(coarse.outcome, MotionOutcome::slipped);
  EXPECT_LT(fine.energy_drift, 0.1 * coarse.energy_drift);
  EXPECT_LT(fine.deepest_penetration, 0.5 * coarse.deepest_penetration);
  EXPECT_EQ(fine.searches, 241u);
  EXPECT_EQ(fine.frame_contacts.size(), 13u);
  for (const auto* result : {&fine, &coarse}) {
    EXPECT_GT(result->contacts, 0u);
    EXPECT_EQ(result->missed + result->invented, 0u);
  }
  const FrameComparison comparison = compare_frames(fine.frame_contacts, coarse.frame_contacts);
  EXPECT_GT(comparison.contacts, 40u);
  EXPECT_GT(4 * comparison.missed, comparison.contacts);
}

// What comes later does not change when it failed first.
TEST(Motion, FailsAtTheFirstTimeThatItSlips) {
  const MotionCase whole = small("aCPU2+CPU2", 2.5);
  const auto failed_at = measure_motion(whole).failed_at;
  ASSERT_TRUE(failed_at.has_value());
  MotionCase cut = whole;
  cut.frames = static_cast<std::uint32_t>(*failed_at / 5) + 2;  // of 5 time units each
  cut.duration = 5 * (cut.frames - 1);
  ASSERT_LT(cut.duration, whole.duration);
  EXPECT_EQ(measure_motion(cut).failed_at, failed_at);
}

TEST(Motion, ShowsWhatTheArithmeticLosesFarFromTheOrigin) {
  EXPECT_EQ(measure_motion(small("aCPU2+CPU2", 0.25, 1e7)).missed, 0u);
  EXPECT_GT(measure_motion(small("aCPU2+CPU2/literal", 0.25, 1e7)).missed, 10u);
}

TEST(Motion, ShowsWhatAMutantLoses) {
  const MotionResult result = measure_motion(small("mutant:lost-update-now-and-then", 0.5));
  EXPECT_GT(result.missed, 10u);
  EXPECT_EQ(result.invented, 0u);
}

/// Of one that loses contacts and invents others: what it found and what there is have the rest in common.
TEST(Motion, TellsWhatIsMissedFromWhatIsInvented) {
  MotionCase each_step = small("mutant:moved-spheres-one-place-off", 2.5);
  each_step.frames = 25;  // of a step each, so that what each search found is kept
  const MotionResult result = measure_motion(each_step);
  ASSERT_EQ(result.searches, result.frame_contacts.size());
  std::uint64_t found = 0;
  for (const auto& pairs : result.frame_contacts) found += pairs.size();
  EXPECT_GT(result.missed, 5u);
  EXPECT_GT(result.invented, 5u);
  EXPECT_EQ(result.contacts - result.missed, found - result.invented);
}

/// The rope of a case, stored so far from the origin along every axis.
motion::RopeMotion rope_of(const MotionCase& c, double away) {
  motion::RopeMotion::Start start;
  Random random(c.seed);
  motion::add_knotted_rope(start, c.n, 1, {}, random);
  motion::RopeSettings settings;
  settings.stretching = c.stiffness;
  const auto place = [away](const Vec3& p) {
    return Sphere{static_cast<float>(p.x + away), static_cast<float>(p.y + away),
                  static_cast<float>(p.z + away), 1};
  };
  return {settings, start, place, StrategyRegistry::instance().make(c.variant)};
}

/// Over what the rope began with and what was done to it.
TEST(Motion, DriftsByAShareOfAllItsEnergy) {
  const MotionCase c = small("CPU1", 0.5);
  motion::RopeMotion rope = rope_of(c, 0);
  double error = 0, work = 0;
  for (int k = 0; k < 120; ++k) {
    ASSERT_TRUE(rope.step(0.5));
    error = std::max(error, std::abs(rope.energy().error()));
    work = std::max(work, rope.energy().work);
  }
  const double initial = rope.energy().initial;
  ASSERT_GT(initial, 0.01);
  EXPECT_DOUBLE_EQ(measure_motion(c).energy_drift, error / (initial + work));
}

/// Moved along every axis, frame by frame.
TEST(Motion, IsThatOfTheRopeWhereItIsStored) {
  const MotionCase c = small("CPU1", 0.5, 4e6);
  motion::RopeMotion rope = rope_of(c, 4e6);
  const auto frames = measure_motion(c).frame_contacts;
  ASSERT_EQ(frames.size(), c.frames);
  const double interval = c.duration / (c.frames - 1);
  const int steps = static_cast<int>(std::lround(interval / 0.5));
  std::size_t contacts = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (int s = 0; f > 0 && s < steps; ++s) ASSERT_TRUE(rope.step(interval / steps));
    EXPECT_TRUE(std::ranges::equal(frames[f], rope.contacts())) << f;
    contacts += frames[f].size();
  }
  EXPECT_GT(contacts, 10u);
}

TEST(Motion, PerturbedStartsAreAsEachByItself) {
  const auto starts = measure_starts(small("aCPU2+CPU2", 2.5), 3);
  ASSERT_EQ(starts.size(), 3u);
  for (const MotionStart& start : starts) {
    MotionCase alone = small("aCPU2+CPU2", 2.5);
    alone.seed = start.seed;
    const MotionResult result = measure_motion(alone);
    EXPECT_EQ(start.outcome, result.outcome);
    EXPECT_EQ(start.failed_at, result.failed_at);
    EXPECT_EQ(start.energy_drift, result.energy_drift);
  }
  EXPECT_NE(starts[0].energy_drift, starts[1].energy_drift) << "another start";
  for (const MotionStart& start : measure_starts(small("mutant:moved-spheres-one-place-off", 2.5), 2)) {
    MotionCase alone = small("mutant:moved-spheres-one-place-off", 2.5);
    alone.seed = start.seed;
    const MotionResult result = measure_motion(alone);
    EXPECT_EQ(start.contacts, result.contacts);
    EXPECT_EQ(start.missed, result.missed);
    EXPECT_EQ(start.invented, result.invented);
    EXPECT_NE(start.missed, start.invented);
  }
  for (std::size_t k = 0; k < starts.size(); ++k) EXPECT_EQ(starts[k].seed, k + 1) << "0 is the start itself";
}

TEST(FailingShare, IsWilsonsInterval) {  // Newcombe 1998, Table I: 81 of 263, 15 of 148, 0 of 20
  const auto share = [](std::size_t failing, std::size_t all) {
    std::vector<MotionStart> starts(all);
    for (std::size_t k = 0; k < failing; ++k) starts[k].outcome = MotionOutcome::slipped;
    return failing_share(starts);
  };
  EXPECT_NEAR(share(81, 263).low, 0.2553, 1e-4);
  EXPECT_NEAR(share(81, 263).high, 0.3662, 1e-4);
  EXPECT_NEAR(share(15, 148).low, 0.0624, 1e-4);
  EXPECT_NEAR(share(15, 148).high, 0.1605, 1e-4);
  EXPECT_EQ(share(0, 20).low, 0);
  EXPECT_NEAR(share(0, 20).high, 0.1611, 1e-4);
}

MotionRow row(const std::string& variant, double stiffness, double step, MotionOutcome outcome) {
  MotionRow r;
  r.motion = small(variant, step);
  r.motion.stiffness = stiffness;
  r.result.outcome = outcome;
  if (outcome != MotionOutcome::holds) r.result.failed_at = 7;
  r.result.missed = 5, r.result.contacts = 10;
  r.result.ms = {3, 1, 2};
  for (std::uint64_t seed = 1; seed <= 32; ++seed) r.starts.push_back({seed, outcome, {}, 0, 0, 0, 0});
  return r;
}

TEST(MotionVerdicts, SayWhereEachFailsAndWhenTheArithmeticIsAtFault) {
  using enum MotionOutcome;
  const auto lines = motion_verdicts({row("CPU1", 1e2, 2, slipped), row("CPU1/literal", 1e2, 2, slipped),
                                      row("CPU1", 1e2, 1, holds), row("CPU1/literal", 1e2, 1, diverged)});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0],
            "CPU1, 0 radii from the origin: stiffness 100: holds at step 1; slips through itself at step 2 "
            "(time 7).");
  EXPECT_EQ(lines[1],
            "CPU1/literal, 0 radii from the origin: stiffness 100: slips through itself at step 2 (time 7), "
            "diverges at step 1 (time 7). Its arithmetic is at fault at stiffness 100, step 1 (fails from "
            "100 % [89, 100] "
            "of 32 starts, CPU1 from 0 % [0, 11]).");
}

TEST(MotionVerdicts, OneStartSaysNothing) {
  using enum MotionOutcome;
  auto exact = row("CPU1", 1e2, 1, holds), rounded = row("CPU1/literal", 1e2, 1, slipped);
  const auto blamed = [&] {
    return motion_verdicts({exact, rounded})[1].find("at fault") != std::string::npos;
  };
  EXPECT_TRUE(blamed());
  rounded.motion.offset = 1e7;
  EXPECT_FALSE(blamed()) << "no exact variant was as far from the origin";
  rounded.motion.offset = exact.motion.offset;
  for (auto* r : {&exact, &rounded}) r->starts.resize(1);
  EXPECT_FALSE(blamed());
  exact.starts.assign(32, {}), rounded.starts.assign(32, {});
  for (std::size_t k = 0; k < 12; ++k) rounded.starts[k].outcome = slipped;
  for (std::size_t k = 0; k < 8; ++k) exact.starts[k].outcome = slipped;
  EXPECT_FALSE(blamed()) << "12 of 32 beside 8 of 32 may be chance";
}

TEST(MotionReport, WritesARowAsJson) {
  MotionRow told = row("CPU1/literal", 1e2, 2, MotionOutcome::slipped);
  told.result.find_ms = 0.25;
  told.against_fine.contacts = 9, told.against_fine.missed = 4;
  told.starts = {{7, MotionOutcome::slipped, 1.5, 0.125, 11, 3, 2},
                 {8, MotionOutcome::holds, {}, 0.25, 12, 1, 5}};
  const auto json = to_json(told);
  ASSERT_EQ(json["starts"].size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& start = json["starts"][k];
    EXPECT_EQ(start["seed"], told.starts[k].seed);
    EXPECT_EQ(start["outcome"], k == 0 ? "slipped" : "holds");
    EXPECT_EQ(start["failed_at"].is_null(), k == 1);
    EXPECT_EQ(start["energy_drift"], told.starts[k].energy_drift);
    EXPECT_EQ(start["contacts"], told.starts[k].contacts);
    EXPECT_EQ(start["missed"], told.starts[k].missed);
    EXPECT_EQ(start["invented"], told.starts[k].invented);
  }
  EXPECT_EQ(json["find_ms"], 0.25);
  EXPECT_EQ(json["reference_contacts"], 9);
  EXPECT_EQ(json["missed_against_fine_step"], 4);
  EXPECT_EQ(json["arithmetic"], "literal");
  EXPECT_EQ(json["outcome"], "slipped");
  EXPECT_EQ(json["failed_at"], 7);
  EXPECT_EQ(json["ms_median"], 2);
  EXPECT_EQ(json["missed_by_variant"], 5);
  EXPECT_TRUE(to_json(row("CPU1", 1e2, 1, MotionOutcome::holds))["failed_at"].is_null());
}

}  // namespace
}  // namespace catena::bench
