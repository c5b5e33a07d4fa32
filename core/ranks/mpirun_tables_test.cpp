// Under mpirun the program writes the tables that one process writes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "catena/core/ranks/test_mpirun.h"

namespace catena {
namespace {

TEST_F(Mpirun, WritesTheTablesOfOneProcess) {
  std::filesystem::create_symlink("linked.csv", file("ranks.csv"));  // to nothing, yet
  for (const std::string input :
       {"coincident:n=60", "yarn:n=3000,seed=5 --arc-window pi/2", "hair:n=900 --window 3",
        "path1:n=2000,frame=5", CATENA_SOURCE_DIR "/core/readers/examples/1A8O.pdb --radius 3"}) {
    for (const char* order : {"chain", "space"})
      for (const char* kind : {"csv", "jsonl"}) {
        const auto tables = [&](const char* of) {
          return fmt::format(" --pairs '{0}.{1}' --counts '{0}.counts.{1}' --depth --margin", file(of), kind);
        };
        const ProgramOutcome alone = run("detect " + input + tables("alone"));
        ASSERT_EQ(alone.code, 0) << alone.output;
        const ProgramOutcome ranks = run_ranks("detect " + input + tables("ranks") + " --order " + order);
        ASSERT_EQ(ranks.code, 0) << ranks.output;
        for (const std::string& end : {std::string(kind), std::string("counts.") + kind}) {
          EXPECT_GT(text_of(file("alone." + end)).size(), 100u);
          EXPECT_EQ(text_of(file("alone." + end)), text_of(file("ranks." + end))) << input << " " << order;
        }
      }
  }
  EXPECT_TRUE(std::filesystem::is_symlink(file("ranks.csv")));
}

/// Ranks read their own parts of a .catena file, and not where options change what it says.
TEST_F(Mpirun, HeedsOptionsBesideAFileThatRanksReadInParts) {
  const std::string input = file("c.catena");
  ASSERT_EQ(run("export coincident:n=60 '" + input + "'").code, 0);
  std::set<std::string> answers;
  for (const char* options : {" --window 25", " --arc-window pi/2"}) {
    const auto table = [&](const char* of) { return fmt::format("{} --pairs '{}'", options, file(of)); };
    ASSERT_EQ(run("detect '" + input + "'" + table("alone.csv")).code, 0) << options;
    const ProgramOutcome ranks = run_ranks("detect '" + input + "'" + table("ranks.csv"));
    ASSERT_EQ(ranks.code, 0) << ranks.output;
    EXPECT_EQ(text_of(file("alone.csv")), text_of(file("ranks.csv"))) << options;
    const auto own = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
    if (!answers.empty()) {
      EXPECT_EQ(std::filesystem::status(file("ranks.csv")).permissions(), own) << "as it was";
    }
    std::filesystem::permissions(file("ranks.csv"), own);
    answers.insert(text_of(file("alone.csv")));
  }
  EXPECT_EQ(answers.size(), 2u) << "each option matters";
}

/// Rank 0 has it, and needs it again for the reference.
TEST_F(Mpirun, TakesStandardInputWhereverItTakesAFile) {
  const std::string chain = file("c.chain");
  ASSERT_EQ(run("export yarn:n=60 '" + chain + "'").code, 0);
  for (const char* command : {"detect", "verify", "bench --json"}) {
    const ProgramOutcome r = run_ranks(fmt::format("{} - --format chain < '{}'", command, chain), 2);
    EXPECT_EQ(r.code, 0) << command << r.output;
  }
}

/// Each number under its own name: what they are to one another.
void expect_work_of_ranks(const nlohmann::json& line) {
  std::set<double> ms, kib;
  for (const auto& phase : line["phases_ms"]) ms.insert(phase.get<double>());
  for (const auto& phase : line["phases_peak_kib"]) kib.insert(phase.get<double>());
  EXPECT_GT(ms.size(), 1u) << line;
  EXPECT_GT(kib.size(), 1u) << line;
  EXPECT_LT(*ms.rbegin(), line["whole_ms"]) << line;
  std::uint64_t asked = 0, touching = 0, most_kib = 0;
  for (const auto& rank : line["of_ranks"]) {
    asked += rank["blocks_asked"].get<std::uint64_t>();
    touching += rank["blocks_touching"].get<std::uint64_t>();
    most_kib = std::max(most_kib, rank["peak_kib"].get<std::uint64_t>());
    EXPECT_LT(rank["rounds"], rank["messages"]) << line;
    EXPECT_LT(rank["messages"], rank["bytes"]) << line;
  }
  EXPECT_GT(touching, 0u) << line;
  EXPECT_LT(touching, asked) << line;
  EXPECT_LE(*kib.rbegin(), most_kib) << line;
}

TEST_F(Mpirun, WritesTheTablesOfOneProcessInABox) {
  std::string frame = text_of(examples + "melt.dump"), wider;
  frame.resize(frame.find("ITEM: TIMESTEP", 1));
  wider = frame;
  wider.replace(wider.find("0 8\n"), 3, "0 12");  // in which nothing touches through a face
  const std::string changing = write("changing.dump", frame + wider + frame);
  for (const std::string& input : std::vector<std::string>{
           changing + " --radius 0.5", "yarn:n=3000,seed=5 --box 30,0,25",
           "hair:n=900 --window 3 --box 20,20,20,3,-2,1", "yarn:n=500 --arc-window pi/2 --box 300,300,300"}) {
    for (const char* order : {"chain", "space"}) {
      const bool all = order == std::string("chain");
      const char* const frames = !input.starts_with(changing) ? "" : all ? " --frame all" : " --frame 2";
      const auto tables = [&](const char* of) {
        return fmt::format("{0} --pairs '{1}.csv' --counts '{1}.counts.csv'{2} --margin", frames, file(of),
                           all ? " --depth" : "");
      };
      const ProgramOutcome alone = run("detect " + input + tables("alone"));
      ASSERT_EQ(alone.code, 0) << alone.output;
      const ProgramOutcome ranks = run_ranks("detect " + input + tables("ranks") + " --order " + order);
      ASSERT_EQ(ranks.code, 0) << ranks.output;
      for (const std::string end : {".csv", ".counts.csv"}) {
        EXPECT_GT(std::ranges::count(text_of(file("alone" + end)), '\n'), 1) << input;
        EXPECT_EQ(text_of(file("alone" + end)), text_of(file("ranks" + end))) << input << " " << order;
      }
    }
  }
  const ProgramOutcome verified = run_ranks("verify yarn:n=2000 --box 30,30,30");
  EXPECT_EQ(verified.code, 0) << verified.output;
  const ProgramOutcome limit = run_ranks("detect yarn:n=3000,seed=5 --box 30,0,25 --pair-limit 5");
  expect_one_line(limit, "yarn:n=3000,seed=5 frame 0: found ");
  const ProgramOutcome timed = run_ranks("bench yarn:n=2000 --box 30,30,30 --repetitions 1");
  ASSERT_EQ(timed.code, 0) << timed.output;
  const auto line = nlohmann::json::parse(timed.output);
  EXPECT_EQ(line["box"], "30,30,30");
  EXPECT_EQ(line["n"], 2000);
  EXPECT_EQ(line["repetitions"], 1);
  const std::string pairs = fmt::format(" {} pairs", line["pairs"].get<std::uint64_t>());
  EXPECT_NE(verified.output.find(pairs), std::string::npos) << timed.output;
  expect_work_of_ranks(line);
}

}  // namespace
}  // namespace catena
