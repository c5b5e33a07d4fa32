#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/bench/motion/report.h"
#include "catena/core/commands/test_program.h"

namespace catena::bench {
namespace {

MotionRow row(const std::string& variant, double stiffness, double offset, std::size_t failing) {
  MotionRow made;
  made.motion = {.stiffness = stiffness, .step = 2, .offset = offset, .variant = variant};
  made.result.ms = {1, 2, 4, 8, 16};
  for (std::size_t k = 0; k < 32; ++k) {
    MotionStart start;
    start.seed = k + 1;
    if (k < failing) start.outcome = MotionOutcome::slipped;
    made.starts.push_back(start);
  }
  return made;
}

TEST(MotionReport, HasTheQuartilesOfTheTime) {
  const auto json = to_json(row("CPU1", 100, 0, 0));
  EXPECT_EQ(json["ms_lower"], 2);
  EXPECT_EQ(json["ms_median"], 4);
  EXPECT_EQ(json["ms_upper"], 8);
}

/// A line for each variant and offset, stiffnesses rising; no exact arithmetic is at fault, whatever fails.
TEST(MotionVerdicts, AreOfEachVariantAndOffset) {
  const auto lines = motion_verdicts({row("CPU1", 1e4, 0, 32), row("CPU1", 1e4, 7, 0), row("CPU1", 100, 0, 0),
                                      row("aCPU2+CPU2", 1e4, 0, 0), row("CPU1", 100, 7, 0)});
  const std::string held = "stiffness 100: holds at step 2; stiffness 10000: holds at step 2.";
  EXPECT_EQ(lines, (std::vector<std::string>{
                       "CPU1, 0 radii from the origin: " + held, "CPU1, 7 radii from the origin: " + held,
                       "aCPU2+CPU2, 0 radii from the origin: stiffness 10000: holds at step 2."}));
}

class MotionProgram : public Program {
 protected:
  void SetUp() override {
    if (!measures_in_this_build()) GTEST_SKIP() << "measures in a Release build only";
  }
  const std::string little = "motion --frames 2 --starts 1 --repetitions 1 ";
  std::vector<nlohmann::json> rows(const std::string& options, int code = 0) const {
    const ProgramOutcome told = run(little + "--n 60 --json " + options);
    EXPECT_EQ(told.code, code) << told.output;
    std::vector<nlohmann::json> found;
    std::istringstream lines(told.output);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('{')) found.push_back(nlohmann::json::parse(line));
    return found;
  }
};

TEST_F(MotionProgram, MeasuresEachStiffnessOffsetStepAndVariant) {
  const auto found = rows(
      "--stiffness 100 --stiffness 200 --step 1 --step 0.5 --offset 0 --offset 8 --variant CPU1 --duration "
      "1");
  ASSERT_EQ(found.size(), 8u);
  std::size_t k = 0;
  for (const double stiffness : {100.0, 200.0})
    for (const double offset : {0.0, 8.0})
      for (const double step : {1.0, 0.5}) {
        const auto& line = found[k++];
        EXPECT_EQ(line["stiffness"], stiffness);
        EXPECT_EQ(line["offset"], offset);
        EXPECT_EQ(line["step"], step);
        EXPECT_EQ(line["reference_step"], 0.5 / 8);
      }
  EXPECT_EQ(rows("--stiffness 100 --step 1 --offset 0 --variant CPU1 --duration 1 --reference-step 0.25")
                [0]["reference_step"],
            0.25);
}

/// An exact variant that misses contacts, or invents them, fails the command; a rounded one may.
TEST_F(MotionProgram, FailsWhereAnExactVariantMissesOrInventsAContact) {
  const std::string one = "--stiffness 1e4 --step 0.5 --offset 0 --duration 60 --variant ";
  EXPECT_EQ(rows(one + "CPU1").size(), 1u);
  const auto missed = rows(one + "mutant:grid-truncates-toward-zero", 1);
  ASSERT_EQ(missed.size(), 1u);
  EXPECT_GT(missed[0]["missed_by_variant"], 0);
  EXPECT_EQ(missed[0]["invented_by_variant"], 0);
  const auto invented = rows(
      "--stiffness 1e4 --step 0.5 --offset 0 --duration 10 --variant mutant:duplicate-over-two-lanes", 1);
  ASSERT_EQ(invented.size(), 1u);
  EXPECT_EQ(invented[0]["missed_by_variant"], 0);
  EXPECT_GT(invented[0]["invented_by_variant"], 0);
}

TEST_F(MotionProgram, RefusesWhatIsNoMotionAndCountsWhatIsLeftOut) {
  expect_refused(little + "--n 41", "--n: 41 is not a whole number from 42");
  for (const std::string option : {"--duration", "--reference-step", "--step", "--stiffness", "--offset"})
    expect_refused(little + option + " nan", option + ": nan is not a number");
  expect_says(little +
                  "--seconds 0 --stiffness 100 --stiffness 200 --step 1 --step 2 --offset 0 --variant CPU1 "
                  "--variant Grid",
              2, {"8 motions left out: --seconds 0 were over", "nothing was measured"});
}

}  // namespace
}  // namespace catena::bench
