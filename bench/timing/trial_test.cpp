#include "catena/bench/timing/trial.h"

#include <gtest/gtest.h>

#include <set>

#include "catena/bench/timing/cases.h"
#include "catena/bench/timing/test_times_told.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/input/input.h"
#include "catena/core/readers/test_file.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/writers/writer.h"
#include "catena/reference/compare.h"
#include "catena/reference/verify.h"

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
  const double whole_ms = trial.run(Stage::whole);
  EXPECT_GE(whole_ms, TimesTold::slept_ms);
  EXPECT_NE(whole_ms, TimesTold::find_ms);
}

/// A sample of runs that take 0 would have no end.
TEST(Trial, TimesABuildThatTheVariantSaysTookNone) {
  Trial trial({"rod:n=1"}, StrategyRegistry::instance().describe("auto"));
  ASSERT_EQ(trial.prepare(), "");
  EXPECT_GT(trial.run(Stage::build), 0);
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
  EXPECT_EQ(calls_of(trial, Stage::find), (std::vector<Call>{{"build", frames[28]}, {"find", frames[28]}}))
      << "on the chain that is named, and with no frame before it to remember";
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

TEST(Trial, ACallGoesThroughAllFramesInTheirOrder) {
  const auto frames = frames_of("path1:n=50");
  Trial trial({"path1:n=50", true}, TimesTold::info());
  std::vector<Call> expected;
  for (int round = 0; round < 2; ++round)
    for (const Sphere& frame : frames)
      expected.push_back({"build", frame}), expected.push_back({"find", frame});
  EXPECT_EQ(calls_of(trial, Stage::whole, 2 * static_cast<int>(frames.size())), expected);
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

/// What a rounded variant gets wrong is allowed; another answer than pairs once and counts of them is not.
TEST(Trial, AMalformedAnswerIsAFaultOfARoundedVariantToo) {
  VariantInfo info = StrategyRegistry::instance().describe("mutant:duplicate-over-two-lanes");
  info.exact = false;
  Trial twice({"coincident:n=60"}, info);
  EXPECT_TRUE(twice.prepare().starts_with("wrong answer: ")) << twice.prepare();
  EXPECT_TRUE(twice.at_fault());
}

/// What is compared after an update, too, is counted once.
TEST(Trial, CountsWhatIsWrongOfAFrameOnce) {
  const Chain far = open_input("far:n=500,exponent=24").animation->frame(0);
  const TestFile film("far.xyz", "");
  const Labels none;
  WriterRegistry::instance()
      .of(film.path())
      .write(film.path(), {0, 2, [&](std::uint32_t) { return ExportedFrame{far}; }, none});
  for (const std::string variant : {"aCPU2+CPU2/literal", "aGPU2@host+GPU2@host/literal"}) {
    const VariantInfo info = StrategyRegistry::instance().describe(variant);
    Trial still({"far:n=500,exponent=24"}, info), moving({film.path().string()}, info);
    ASSERT_EQ(still.prepare(), "");
    ASSERT_EQ(moving.prepare(), "");
    EXPECT_GT(still.missing() + still.invented(), 0u) << variant;
    EXPECT_EQ(moving.missing(), still.missing()) << variant;
    EXPECT_EQ(moving.invented(), still.invented()) << variant;
  }
}

/// Four frames whose pairs are found in their own box only: what touches across a face lies apart in every
/// other.
std::string boxes_that_change() {
  std::string text;
  for (const int length : {10, 12, 11, 13}) {
    const auto corner =
        std::to_string(length) + " 0 0 0 " + std::to_string(length) + " 0 0 0 " + std::to_string(length);
    text += "3\nLattice=\"" + corner + "\" Properties=species:S:1:pos:R:3:radius:R:1 pbc=\"T T T\"\n";
    text += "C 0.25 0 0 0.5\nC 5 0 0 0.5\nC " + std::to_string(length - 1) + ".25 0 0 0.5\n";
  }
  return text;
}

// What an update comes from is the frame before, in that frame's box.
TEST(Trial, IsUpdatedFromTheFrameBefore) {
  const TestFile changing("boxes.xyz", boxes_that_change()), two("two.xyz", "1\nt\n0 0 0\n1\nt\n5 0 0\n");
  InputOptions with_radius;
  with_radius.radius = 1.0f;
  for (const auto& spec : {WorkloadSpec{changing.path().string()}, WorkloadSpec{"path1:n=30"},
                           WorkloadSpec{two.path().string(), false, with_radius}}) {
    const auto work = workload(spec);
    const Input input = open_input(spec.input, spec.options);
    ASSERT_GT(work->first_frame, 0u);
    ASSERT_TRUE(work->beside.has_value());
    const Chain before = input.animation->frame(work->first_frame - 1);
    EXPECT_TRUE(std::ranges::equal(work->beside->spheres(), before.spheres())) << spec.input;
    if (!input.boxes.empty()) {
      EXPECT_EQ(*work->box_beside, *box_of(input.boxes, work->first_frame - 1));
    }
  }
}

TEST(Trial, SearchesEachFrameInItsOwnBox) {
  const TestFile file("boxes.xyz", boxes_that_change());
  for (const bool all_frames : {false, true}) {
    const WorkloadSpec spec{file.path().string(), all_frames};
    const auto work = workload(spec);
    ASSERT_EQ(work->boxes.size(), work->chains.size());
    for (const auto& exact : work->exact) EXPECT_EQ(exact.pairs, (std::vector<Pair>{{0, 2}}));
    EXPECT_EQ(work->label, all_frames ? "boxes.xyz:frames=all,box=file/n:3" : "boxes.xyz:box=file/n:3");
    for (const char* variant : {"CPU1", "Hybrid", "auto", "aCPU2+CPU2", "aCPU2+CPU2/double"}) {
      Trial trial(spec, StrategyRegistry::instance().describe(variant));
      for (const Stage stage :
           {Stage::build, Stage::update, Stage::whole, Stage::find, Stage::update, Stage::find}) {
        ASSERT_EQ(trial.prepare(), "") << variant;
        EXPECT_GE(trial.run(stage), 0) << variant;
      }
      EXPECT_EQ(trial.pairs(), 1u);
      EXPECT_EQ(trial.missing() + trial.invented(), 0u);
    }
  }
}

/// The last sphere of what a variant is given is an image, so that it tells the box: in every round the same
/// of each frame.
TEST(Trial, TimesEachFrameInItsOwnBox) {
  const TestFile file("boxes.xyz", boxes_that_change());
  Trial trial({file.path().string(), true}, TimesTold::info());
  TimesTold::calls.clear();
  ASSERT_EQ(trial.prepare(), "");
  std::vector<Sphere> found;
  for (const Call& call : TimesTold::calls)
    if (call.stage == "find" && found.size() < 4) found.push_back(call.last);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(std::set<float>({found[0].x, found[1].x, found[2].x, found[3].x}).size(), 4u);
  for (const Stage stage : {Stage::whole, Stage::find, Stage::build}) {
    std::vector<Sphere> timed;
    for (const Call& call : calls_of(trial, stage, 8))
      if (call.stage == (stage == Stage::build ? "build" : "find")) timed.push_back(call.last);
    ASSERT_EQ(timed.size(), 8u) << name_of(stage);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(timed[k], found[k % 4]) << name_of(stage) << ' ' << k;
  }
}

/// A rounded variant is timed, and what it gets wrong is counted: it invents where all graze, and misses far
/// away.
TEST(Trial, CountsWhatARoundedVariantMissesAndInvents) {
  std::uint64_t missing = 0, invented = 0;
  for (const char* spec : {"grazing:n=400,margin=1e-8", "far:n=500,exponent=24"}) {
    const Input input = open_input(spec);
    const Chain chain = input.animation->frame(0);
    Collisions found;
    const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2/literal");
    variant->build(chain);
    variant->find(chain, {}, found);
    const auto comparison = reference::compare(chain, reference::exact_answer(chain, 1u << 20), found);
    Trial trial({spec}, StrategyRegistry::instance().describe("aCPU2+CPU2/literal"));
    ASSERT_EQ(trial.prepare(), "");
    EXPECT_EQ(trial.missing(), comparison.missing) << spec;
    EXPECT_EQ(trial.invented(), comparison.invented) << spec;
    missing += comparison.missing, invented += comparison.invented;
  }
  EXPECT_GT(missing, 0u);
  EXPECT_GT(invented, 0u);
}

// The answer is that of `detect --box`, by any variant and the reference.
TEST(Trial, InABoxTimesWhatDetectAnswers) {
  WorkloadSpec spec{example("melt.data").string()};
  read_input_options({"--radius", "0.5", "--box", "file"}, spec.options);
  const auto work = workload(spec);
  EXPECT_EQ(work->exact[0].pairs, (std::vector<Pair>{{1, 4}, {2, 4}}));
  auto variant = work->make("Hybrid");
  Collisions found;
  variant->build(work->chains[0]);
  variant->find(work->chains[0], {}, found);
  std::ranges::sort(found.pairs);
  EXPECT_EQ(found.pairs, work->exact[0].pairs);
  for (const Case& c : cases({spec}, StrategyRegistry::instance().variants()))
    EXPECT_NE(c.stage, Stage::resident);
}

/// Each stage that is measured of a device's variants can be: DeviceParts takes chains of the host alone.
TEST(DeviceTrial, EveryStageOfEveryVariantIsTimed) {
  std::vector<VariantInfo> variants = StrategyRegistry::instance().variants();
  std::erase_if(variants, [](const VariantInfo& v) { return !v.on_device(); });
  if (variants.empty()) GTEST_SKIP() << "built without CUDA";
  if (variants[0].unavailable) GTEST_SKIP() << *variants[0].unavailable;
  std::set<Stage> stages;
  for (const Case& c : cases({{"yarn:n=500"}, {"path1:n=500"}}, variants)) {
    Trial trial(c.spec, c.variant);
    ASSERT_EQ(trial.prepare(), "") << c.name();
    EXPECT_GT(trial.run(c.stage), 0) << c.name();
    stages.insert(c.stage);
  }
  EXPECT_EQ(stages.size(), 5u);
}

TEST(Trial, TellsTheMostPairsOfAnyFrameAndComparesOnce) {
  const auto& registry = StrategyRegistry::instance();
  Trial frames({"path1:n=100", true}, registry.describe("aCPU2+CPU2"));
  ASSERT_EQ(frames.prepare(), "");
  const auto animation = open_input("path1:n=100").animation;
  std::uint64_t most = 0, last = 0;
  for (std::uint32_t f = 0; f < animation->frames(); ++f)
    most = std::max(most, last = reference::find(animation->frame(f)).pair_count);
  ASSERT_LT(last, most);
  EXPECT_EQ(frames.pairs(), most);
  Trial rounded({"coincident:n=60"}, registry.describe("aCPU2+CPU2/literal"));
  ASSERT_EQ(rounded.prepare(), "");
  const auto missing = rounded.missing();
  EXPECT_GT(missing, 0u);
  rounded.release();
  ASSERT_EQ(rounded.prepare(), "");
  EXPECT_EQ(rounded.missing(), missing) << "not counted again";
}

TEST(Trial, ALabelSaysNInDigits) { EXPECT_EQ(label_of({"path1:spacing=2,n=1e3"}), "path1:spacing=2/n:1000"); }

TEST(Trial, WhatDoesNotMoveHasNoUpdate) {
  Trial trial({"yarn:n=50"}, TimesTold::info());
  ASSERT_EQ(trial.prepare(), "");
  EXPECT_THROW(trial.run(Stage::update), std::logic_error);
}

}  // namespace
}  // namespace catena::bench
