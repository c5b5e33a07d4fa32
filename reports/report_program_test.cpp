#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "catena/core/commands/test_program.h"
#include "catena/core/environment.h"
#include "catena/core/shell_word.h"
#include "catena/reports/journal.h"

/// `catena report` as a user runs it: what is asked for is what is measured, and an interrupted run goes on
/// with it.
namespace catena::reports {
namespace {

class ReportProgram : public Program {
 protected:
  /// The run that was written, or nothing where this program measures nothing.
  nlohmann::json measured(const std::string& arguments) const {
    if (!measures_in_this_build()) return {};
    const ProgramOutcome r = run("report " + arguments + " --output '" + file("r") + "'");
    if (r.output.find("libbenchmark-dev") != std::string::npos) return {};
    EXPECT_EQ(r.code, 0) << r.output;
    EXPECT_TRUE(std::filesystem::exists(file("r") + "/run.json")) << r.output;
    EXPECT_FALSE(std::filesystem::exists(file("r") + "/run.journal"));
    EXPECT_FALSE(std::filesystem::exists(file("r") + "/index.html")) << "--no-page";
    return nlohmann::json::parse(text_of(file("r") + "/run.json"));
  }
};

TEST_F(ReportProgram, MeasuresWhatIsAskedForAndSaysHow) {
  write("an a.xyz", "0 0 0\n1 0 0\n2 0 0\n");
  const std::string asked = "--scene " + shell_word(file("an a.xyz")) +
                            " --radius 0.5 --variant CPU1 --variant 'GPU1@host(threads=1)' --seconds 60 "
                            "--repetitions 3 --seed 7";
  const auto run = measured(asked + " --no-page");
  if (run.is_null()) GTEST_SKIP() << "it cannot measure";
  const auto& own = run["catena"];
  EXPECT_EQ(own["command"], "catena report --quick " + asked);
  EXPECT_EQ(own["profile"], "custom");
  EXPECT_EQ(own["stopping"]["seed"], 7);
  EXPECT_EQ(own["stopping"]["share"], 0);
  EXPECT_EQ(own["stopping"]["seconds"], 60);
  EXPECT_EQ(own["stopping"]["most_samples"], 3);
  EXPECT_EQ(own["stopping"]["rounds"], 3);
  for (const char* section : {"stability", "judged", "ranks", "motion", "keyframes", "tube_errors", "examine",
                              "coherence", "animation", "regret", "steps"})
    EXPECT_FALSE(own.contains(section)) << section << " is of other chains, or of frames that follow";
  EXPECT_FALSE(own.contains("savings")) << "no chain of catena's own";
  for (const auto& row : run["benchmarks"]) {
    EXPECT_EQ(row["missing"], 0) << row << ": that nothing was wrong is said";
    EXPECT_EQ(row["invented"], 0) << row;
  }
  EXPECT_EQ(own["viewer"].size(), 1u);
  EXPECT_EQ(own["wants"].size() % 2, 0u);
}

TEST_F(ReportProgram, GoesOnWithTheOptionsOfTheRunThatWasInterrupted) {
  const std::string points = file("a.xyz");
  write("a.xyz", "0 0 0\n1 0 0\n2 0 0\n");
  const nlohmann::ordered_json options{{"profile", "quick"},
                                       {"scenes", {points}},
                                       {"input", {"--radius", "0.5"}},
                                       {"variants", {"CPU1", "aCPU2+CPU2"}},
                                       {"filter", "find"},
                                       {"seconds", 60.0},
                                       {"repetitions", 4},
                                       {"seed", 9},
                                       {"no_page", true}};
  std::filesystem::create_directories(file("r"));
  auto here = environment();
  Journal::begin(file("r") + "/run.journal", {{"options", options}, {"environment", here}});
  const auto run = measured("--resume");
  if (run.is_null()) GTEST_SKIP() << "it cannot measure";
  EXPECT_EQ(run["catena"]["command"],
            fmt::format("catena report --quick --scene {} --radius 0.5 --variant CPU1 --variant aCPU2+CPU2 "
                        "--benchmark_filter find --seconds 60 --repetitions 4 --seed 9",
                        shell_word(points)));
  EXPECT_EQ(run["catena"]["stopping"]["rounds"], 4);
  for (const auto& row : run["benchmarks"])
    EXPECT_NE(std::string(row["name"]).find("/find"), std::string::npos) << row["name"];
  here.begin()->second = "another";
  Journal::begin(file("r") + "/run.journal", {{"options", options}, {"environment", here}});
  expect_refused("report --resume --output '" + file("r") + "'",
                 fmt::format("the interrupted run had the {} 'another', this is '", here.begin()->first));
}

/// Who is told to measure anew does so, and it may take an hour.
TEST_F(ReportProgram, SaysHowToMakeThePageOfAWholeRunThatIsToBeResumed) {
  std::filesystem::create_directories(file("r"));
  write("r/run.json", "{}");
  expect_refused(
      "report --resume --output '" + file("r") + "'",
      fmt::format("{0}/run.json holds a whole run, which nothing interrupted; its page: catena report "
                  "--output {0} --from {0}/run.json",
                  file("r")));
}

/// Where it is refused only after it was measured, nothing of the run can be told or gone on with.
TEST_F(ReportProgram, RefusesANameThatARunFileCannotHold) {
  if (!measures_in_this_build()) GTEST_SKIP() << "measures in a Release build only";
  write("bad\xFF.xyz", "0 0 0\n1 0 0\n2 0 0\n");
  expect_refused("report --seconds 60 --variant CPU1 --radius 0.5 --output '" + file("r") + "' --scene '" +
                     file("bad\xFF.xyz") + "'",
                 "bad?.xyz: this name is not UTF-8, which a run file needs; rename it, or give a link to it");
  EXPECT_FALSE(std::filesystem::exists(file("r")));
}

TEST_F(ReportProgram, SaysHowLongItTimesAtMost) {
  if (!measures_in_this_build()) GTEST_SKIP() << "measures in a Release build only";
  const std::string run =
      "report --no-page --scene path1:n=50 --variant CPU1 --benchmark_filter find --output '";
  expect_says(run + file("a") + "' --seconds 0.25", 0, {"timing 1 case for at most 0.25 s\n"});
  expect_says(run + file("b") + "' --seconds 60 --repetitions 1", 0, {"timing 1 case for at most 60 s\n"});
  expect_says(run + file("c") + "' --repetitions 1", 0, {"timing 1 case\n"});
}

TEST_F(ReportProgram, KeepsTheRunThatIsThereAndSaysWhere) {
  if (measured("--scene path1:n=50 --variant CPU1 --repetitions 1 --no-page").is_null())
    GTEST_SKIP() << "it cannot measure";
  const std::string first = text_of(file("r") + "/run.json");
  const std::string kept =
      "catena: " + file("r") + "/run.json held an earlier run, which is now " + file("r") + "/run-1.json\n";
  expect_says(
      "report --scene path1:n=60 --variant CPU1 --repetitions 1 --no-page --output '" + file("r") + "'", 0,
      {kept});
  EXPECT_EQ(text_of(file("r") + "/run-1.json"), first);
  EXPECT_NE(text_of(file("r") + "/run.json"), first);
}

}  // namespace
}  // namespace catena::reports
