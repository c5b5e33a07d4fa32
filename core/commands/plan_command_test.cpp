#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catena/core/commands/plan_report.h"
#include "catena/core/commands/test_program.h"

namespace catena {
namespace {

/// `catena plan` and `catena calibrate`, with a cache of their own.
class PlanProgram : public Program {
 protected:
  PlanProgram() { setenv("XDG_CACHE_HOME", file("cache").c_str(), 1); }
  ~PlanProgram() override { unsetenv("XDG_CACHE_HOME"); }
  std::string figures() const { return file("cache/catena/calibration.txt"); }
  nlohmann::json json(const std::string& arguments) const {
    const ProgramOutcome r = run(arguments);
    EXPECT_EQ(r.code, 0) << r.output;
    return nlohmann::json::parse(r.output);
  }
  static nlohmann::json step(const nlohmann::json& line, const std::string& name) {
    for (const auto& s : line["plan"])
      if (s["step"] == name) return s;
    return nullptr;
  }
};

TEST_F(PlanProgram, SaysWhatIsLeftOutAndAfterARunWhatThatTook) {
  expect_says("plan path1:n=20", 0, {"hierarchy", "left out", "20 spheres", "built-in figures", "estimate"});
  const auto before = json("plan path1:n=20,frame=3 --counts-only --json"),
             after = json("plan path1:n=20 --run --json");
  EXPECT_FALSE(before.contains("collides"));
  EXPECT_EQ(before["frame"], 3) << "of the scene, as other commands tell it";
  EXPECT_EQ(json("plan path1:n=20,frame=3 --run --json")["frame"], 3) << "after a run, too";
  EXPECT_EQ(before["n"], 20);
  EXPECT_TRUE(after["collides"]);
  EXPECT_TRUE(json("plan path1:n=20000 --run --any --json")["collides"]) << "though no pair is counted";
  EXPECT_TRUE(step(before, "hierarchy")["left_out"]);
  EXPECT_TRUE(step(before, "pair list")["left_out"]);
  EXPECT_FALSE(step(after, "pair list")["left_out"]);
  for (const char* timed : {"choice of variant", "planning", "hierarchy", "build", "search"})
    EXPECT_TRUE(step(after, timed).contains("actual_ms")) << timed;
  EXPECT_EQ(step(after, "search")["reason"], "of 190 pairs of spheres: each");
  for (const auto& s : before["plan"])
    EXPECT_FALSE(s.contains("actual_ms") || s.contains("removed")) << "nothing was run: " << s;
}

/// What a step took is part of the whole, and what it spared is told in numbers.
TEST_F(PlanProgram, TellsOfEachStepWhatItTookAndWhatWasRemoved) {
  const auto run = json("plan path1:n=20000 --run --counts-only --json");
  const auto ms = [&](const char* name) { return step(run, name)["actual_ms"].get<double>(); };
  EXPECT_NEAR(ms("choice of variant"), ms("build") + ms("search"), 1e-9);
  EXPECT_EQ(ms("hierarchy"), ms("build"));
  EXPECT_GT(ms("build"), 0);
  EXPECT_GT(ms("search"), 0);
  EXPECT_TRUE(
      step(run, "search")["reason"].get<std::string>().starts_with("of 199990000 pairs of spheres: "));
  EXPECT_TRUE(step(run, "search within straight stretches")["removed"].get<std::string>().ends_with(
      " pairs of blocks of 8 spheres"));
  const auto detected = json("detect path1:n=20000 --json");
  EXPECT_EQ(step(run, "pair list")["removed"], fmt::format("{} pairs", detected["pairs"].get<int>()));
  const auto looked = json("plan path1:n=20000 --run --any --json");
  EXPECT_TRUE(step(looked, "build before a look at the likeliest places").contains("actual_ms"));
  EXPECT_EQ(step(looked, "build"), nullptr) << "nothing was built";
}

/// At most a hundredth of a run, once threads are started.
TEST_F(PlanProgram, PlansInAHundredthOfARun) {
  double least = 100;  // of some, as others may take the processor
  for (int k = 0; k < 5; ++k) {
    const std::string reason =
        step(json("plan path1:n=150000 --run --json"), "planning")["reason"].get<std::string>();
    double again = 0, share = 100;
    ASSERT_EQ(std::sscanf(reason.c_str(), "once more %lf ms, %lf %%", &again, &share), 2) << reason;
    least = std::min(least, share);
  }
  EXPECT_LE(least, 1);
}

TEST(PlanReport, HasAColumnForWhatAnyStepSays) {
  const Plan plan{{"one", true, "a reason", 1.23456, 7.0, "all of it"}, {"another", false, "why not", 0.5}};
  EXPECT_EQ(plan_table({}, "> "), "> every step is done: there is none to choose\n");
  EXPECT_EQ(plan_table(plan, "> "),
            "> step               estimate  actual  removed    because\n"
            "> one      left out  1.23 ms   7 ms    all of it  a reason\n"
            "> another  done      0.5 ms                       why not\n");
  EXPECT_EQ(plan_table({plan[1]}, ""),
            "step           estimate  because\nanother  done  0.5 ms    why not\n");
  EXPECT_EQ(
      to_json(plan).dump(),
      R"([{"step":"one","left_out":true,"reason":"a reason","estimate_ms":1.23456,"actual_ms":7.0,)"
      R"("removed":"all of it"},{"step":"another","left_out":false,"reason":"why not","estimate_ms":0.5}])");
}

TEST_F(PlanProgram, OmitsNothingThatIsSwitchedOff) {
  const auto run =
      json("plan yarn:n=3000 --run --counts-only --no-omit hierarchy --no-omit pair-list --json");
  EXPECT_FALSE(step(run, "pair list")["left_out"]);
  EXPECT_TRUE(step(json("plan yarn:n=3000 --run --counts-only --json"), "pair list")["left_out"]);
  EXPECT_FALSE(step(json("plan path1:n=20 --no-omit hierarchy --json"), "hierarchy")["left_out"]);
  for (const std::string name : {"strand table", "range checks"}) {
    std::string option = " --no-omit " + name;
    option[option.rfind(' ')] = '-';
    EXPECT_TRUE(step(json("plan path1:n=20 --run --json"), name)["left_out"]) << name;
    EXPECT_FALSE(step(json("plan path1:n=20 --run --json" + option), name)["left_out"]) << name;
  }
  expect_says("detect path1:n=20 --no-omit hierarchy", 0, {"auto(keep=hierarchy), ChainTree"});
  expect_refused("plan path1:n=20 --no-omit nonsense", "hierarchy");
  expect_refused("detect path1:n=20 --variant CPU1 --no-omit hierarchy", "--variant");
  expect_refused("plan path1:n=20 --any --counts-only", "--any");
}

TEST_F(PlanProgram, IsOfTheSearchInABox) {
  const std::string melt =
      "plan '" CATENA_SOURCE_DIR "/core/readers/examples/melt.data' --radius 0.5 --box file";
  expect_says(melt + " --run", 0, {"8 spheres, collides", "choice of variant"});
  expect_refused(melt, "add --run");
  // Each frame in its own box: in the second, wider one the ends do not touch through a face.
  const auto frame = [](const char* edge) {
    return std::string("3\nLattice=\"") + edge + " 0 0 0 9 0 0 0 9\"\nC 0 0 0\nC 3.5 4 0\nC 7 0 0\n";
  };
  const std::string moving = write("boxes.xyz", frame("8") + frame("20"));
  const std::string said = run("plan " + moving + " --radius 1 --run --frame all").output;
  EXPECT_NE(said.find("frame 0: 3 spheres, collides"), std::string::npos) << said;
  EXPECT_NE(said.find("frame 1: 3 spheres, does not collide"), std::string::npos) << said;
}

TEST_F(PlanProgram, FramesOfAnAnimationAreToldWhatTheyShare) {
  const ProgramOutcome r = run("plan path1:n=30000 --frame all --run --json");
  std::istringstream lines(r.output);
  std::size_t shifted = 0, frames = 0;
  for (std::string line; std::getline(lines, line); ++frames)
    shifted += step(nlohmann::json::parse(line), "search of the shifted part") != nullptr;
  EXPECT_EQ(frames, 56u);
  EXPECT_EQ(shifted, 55u);
}

TEST_F(PlanProgram, UsesTheFiguresThatCalibrateKeepsAndSaysSoWhenTheyAreDamaged) {
  // Asked about a chain whose kind takes nobody's place, whatever was measured: there the figures decide.
  expect_says("calibrate", 0, {"Hybrid", "CPU1", "spheres on", figures()});
  expect_says("plan path1:n=7000", 0, {"figures of " + figures()});
  std::ofstream(figures()) << "nonsense";
  const ProgramOutcome r = run("plan path1:n=7000");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.output.find("catena: " + figures()), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("built-in figures"), std::string::npos) << r.output;
  const auto told = json("calibrate --json");
  EXPECT_GT(told["crossover"], 1);
  EXPECT_TRUE(told["hardly_helped"].is_array());
  std::istringstream kept(text_of(figures()));
  std::string line;
  std::getline(kept, line), std::getline(kept, line);  // what it is, and of which processor
  for (const auto& cost : told["costs"]) {             // what is kept is what is told
    std::getline(kept, line);
    std::istringstream words(line);
    std::string variant;
    words >> variant;
    EXPECT_EQ(variant, cost["variant"]);
    for (const char* key : {"fixed_us", "sphere_ns", "sphere_pair_ns", "serial", "team_us", "start_ms"}) {
      double figure = -1;
      words >> figure;
      EXPECT_EQ(figure, cost[key]) << variant << ' ' << key;
    }
  }
  expect_says("plan path1:n=7000", 0, {"figures of " + figures()});
  setenv("XDG_CACHE_HOME", "/dev/null", 1);
  expect_refused("calibrate", "cannot make /dev/null");
}

/// What is told is what is kept, to three digits, under the names of the columns.
TEST_F(PlanProgram, TellsWhatCalibrateKeepsInATable) {
  const ProgramOutcome told = run("calibrate");
  ASSERT_EQ(told.code, 0) << told.output;
  std::istringstream lines(told.output), kept(text_of(figures()));
  std::string line, row;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "variant                     fixed, us   a sphere, ns   a pair, ns  threads, us       serial  "
            "start, ms");
  std::getline(kept, row), std::getline(kept, row);
  std::size_t variants = 0;
  for (; std::getline(kept, row) && row != "end"; ++variants) {
    std::getline(lines, line);
    std::istringstream words(row), shown(line);
    std::string variant, name;
    double fixed = 0, sphere = 0, pair = 0, serial = 0, team = 0, start = 0;
    words >> variant >> fixed >> sphere >> pair >> serial >> team >> start;
    shown >> name;
    EXPECT_EQ(name, variant);
    for (const double figure : {fixed, sphere, pair, team, serial, start}) {
      std::string number;
      shown >> number;
      EXPECT_EQ(number, fmt::format("{:.3g}", figure)) << line;
    }
  }
  EXPECT_GT(variants, 1u);
}

TEST_F(PlanProgram, CalibrateNeedsAFolderForWhatItKeeps) {
  const char* const home = std::getenv("HOME");
  const std::string before = home != nullptr ? home : "";
  unsetenv("XDG_CACHE_HOME"), unsetenv("HOME");
  expect_refused("calibrate", "XDG_CACHE_HOME");
  if (home != nullptr) setenv("HOME", before.c_str(), 1);
}

}  // namespace
}  // namespace catena
