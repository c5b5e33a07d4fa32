#include "catena/bench/timing/trial.h"

#include <gtest/gtest.h>

#include "catena/bench/timing/times_told.h"
#include "catena/core/input/input.h"

namespace catena::bench {
namespace {

using Call = TimesTold::Call;

/// Every frame of an input, by the sphere that TimesTold notes.
std::vector<Sphere> frames_of(const std::string& spec) {
  const Input input = open_input(spec);
  std::vector<Sphere> frames;
  for (std::uint32_t f = 0; f < input.animation->frames(); ++f) {
    const Chain chain = input.animation->frame(f);
    frames.push_back(chain[chain.size() - 1]);
  }
  return frames;
}

/// The calls that runs of a stage make, once the trial is ready.
std::vector<Call> calls_of(Trial& trial, Stage stage, int runs = 1) {
  EXPECT_EQ(trial.prepare(), "");
  TimesTold::calls.clear();
  for (int run = 0; run < runs; ++run) trial.run(stage);
  return TimesTold::calls;
}

TEST(Trial, TimesEachStageByItsOwnClock) {
  Trial trial({"path1:n=50"}, TimesTold::info());
  ASSERT_EQ(trial.prepare(), "");
  EXPECT_EQ(trial.run(Stage::build), TimesTold::build_ms);
  EXPECT_EQ(trial.run(Stage::update), TimesTold::update_ms);
  EXPECT_EQ(trial.run(Stage::find), TimesTold::find_ms);
  EXPECT_GE(trial.run(Stage::whole), TimesTold::slept_ms);
}

TEST(Trial, BuildsWhereItTimesABuild) {
  const Sphere middle = frames_of("path1:n=50")[28];
  Trial trial({"path1:n=50"}, TimesTold::info());
  EXPECT_EQ(calls_of(trial, Stage::build), (std::vector<Call>{{"build", middle}}));
  EXPECT_EQ(calls_of(trial, Stage::whole), (std::vector<Call>{{"build", middle}, {"find", middle}}));
  EXPECT_EQ(calls_of(trial, Stage::find), (std::vector<Call>{{"find", middle}}));
}

TEST(Trial, AnUpdateMovesToAndFroTheFrameBeside) {
  const auto frames = frames_of("path1:n=50");
  ASSERT_NE(frames[27], frames[28]);
  Trial trial({"path1:n=50"}, TimesTold::info());
  EXPECT_EQ(calls_of(trial, Stage::update, 3),
            (std::vector<Call>{{"update", frames[27]}, {"update", frames[28]}, {"update", frames[27]}}));
  EXPECT_EQ(calls_of(trial, Stage::find), (std::vector<Call>{{"update", frames[28]}, {"find", frames[28]}}))
      << "on the chain that is named, whatever was updated before";
}

TEST(Trial, AnUpdateGoesThroughAllFramesInTheirOrder) {
  const auto frames = frames_of("path1:n=50");
  Trial trial({"path1:n=50", true}, TimesTold::info());
  const auto calls = calls_of(trial, Stage::update, static_cast<int>(frames.size()));
  std::vector<Call> expected{
      {"update", frames[1]}};  // not timed: the first frame is no neighbour of the last
  for (const Sphere& frame : frames) expected.push_back({"update", frame});
  EXPECT_EQ(calls, expected);
}

TEST(Trial, ComparesTheAnswerAfterAnUpdateToo) {
  const auto frames = frames_of("path1:n=50");
  Trial trial({"path1:n=50"}, TimesTold::info());
  TimesTold::calls.clear();
  ASSERT_EQ(trial.prepare(), "");
  EXPECT_EQ(TimesTold::calls, (std::vector<Call>{{"build", frames[28]},
                                                 {"find", frames[28]},
                                                 {"update", frames[27]},
                                                 {"update", frames[28]},
                                                 {"find", frames[28]}}));
}

TEST(Trial, AThrowIsTheVariantsFaultAndARefusalIsNot) {
  const auto& registry = StrategyRegistry::instance();
  Trial throws({"path1:n=50"}, registry.describe("mutant:throws-past-32-spheres"));
  EXPECT_TRUE(throws.prepare().starts_with("mutant:throws-past-32-spheres threw: stack slot 32 of 32"));
  EXPECT_TRUE(throws.at_fault());
  Trial refuses({"path1:n=2000"}, registry.describe("bGPU2@host+CPU2"));
  EXPECT_NE(refuses.prepare(), "");
  EXPECT_FALSE(refuses.at_fault());
  Trial wrong({"lattice:n=60"}, registry.describe("mutant:less-for-less-equal"));
  EXPECT_TRUE(wrong.prepare().starts_with("wrong answer: "));
  EXPECT_TRUE(wrong.at_fault());
}

TEST(Trial, ALabelSaysNInDigits) { EXPECT_EQ(label_of({"path1:spacing=2,n=1e3"}), "path1:spacing=2/n:1000"); }

TEST(Trial, WhatDoesNotMoveHasNoUpdate) {
  Trial trial({"yarn:n=50"}, TimesTold::info());
  ASSERT_EQ(trial.prepare(), "");
  EXPECT_THROW(trial.run(Stage::update), std::logic_error);
}

}  // namespace
}  // namespace catena::bench
