// What the program says of itself and of what it finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "catena/core/commands/test_program.h"

namespace catena {
namespace {

using Outcome = ProgramOutcome;

TEST_F(Program, SaysWhatItIs) {
  expect_says("--help", 0, {"detect", "verify", "fuzz", "list"});
  const Outcome version = run("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.output, CATENA_VERSION "\n");
  expect_says("detect --help", 0, {"--variant", "--frame", "--pairs"});
}

TEST_F(Program, ListsVariantsScenesAndReaders) {
  expect_says("list", 0, {"aCPU2+CPU2", "path1", ".swc", "subtree=384"});
  const std::string spoken = run("list").output;
  const std::string scale = "factor on every coordinate and radius";
  EXPECT_NE(spoken.find(scale), std::string::npos);
  EXPECT_EQ(spoken.find(scale), spoken.rfind(scale)) << "what is common to all scenes, once";
  const std::string printed = run("list --json").output;
  EXPECT_EQ(std::ranges::count(printed, '\n'), 1);
  const auto list = nlohmann::json::parse(printed);
  EXPECT_GE(list["variants"].size(), 40u);
  for (const auto& variant : list["variants"]) {
    for (const char* key :
         {"name", "arithmetic", "device", "unavailable", "stages", "exact", "peer", "evidence"})
      EXPECT_TRUE(variant.contains(key)) << variant << " lacks " << key;
    EXPECT_EQ(variant["device"], variant["on_device"]) << variant;
  }
  EXPECT_GE(list["scenes"].size(), 20u);
  for (const auto& scene : list["scenes"]) EXPECT_FALSE(scene["parameters"].empty()) << scene["name"];
}

TEST_F(Program, DetectsWithEveryKindOfAnswer) {
  expect_says("detect coincident:n=60 --any", 0, {"60 spheres, collides"});
  expect_says("detect rod:n=60 --any", 0, {"does not collide"});
  expect_says("detect coincident:n=60 --counts-only", 0, {"812 pairs, at most 28 a sphere"});
  expect_says("detect path1:n=100 --frame all", 0, {"frame 0:", "frame 55:"});
  const auto line = nlohmann::json::parse(run("detect coincident:n=60 --json").output);
  EXPECT_EQ(line["pairs"], 812);
  EXPECT_EQ(line["collides"], true);
  EXPECT_EQ(line["n"], 60);
  EXPECT_FALSE(nlohmann::json::parse(run("detect coincident:n=60 --any --json").output).contains("pairs"));
}

TEST_F(Program, SaysTheMostOfAnySphere) {
  const std::string counts = file("counts.jsonl");
  for (const char* input : {"path1:n=1000 --frame 28", "yarn:n=300", "coincident:n=60"}) {
    const auto line = nlohmann::json::parse(
        run(std::string("detect ") + input + " --json --counts '" + counts + "'").output);
    std::istringstream rows(text_of(counts));
    int most = 0, first = -1;
    for (std::string row; std::getline(rows, row);) {
      const int count = nlohmann::json::parse(row)["count"];
      most = std::max(most, count);
      if (first < 0) first = count;
    }
    EXPECT_EQ(line["max_count"], most) << input;
    EXPECT_GT(most, 0) << input;
    if (std::string_view(input).starts_with("path1")) {
      EXPECT_LT(first, most) << "it is not the first sphere's";
    }
  }
}

TEST_F(Program, KeepsPairsOnlyForWhoReadsThem) {
  const auto kept = [&](const std::string& options) {
    const auto line = nlohmann::json::parse(run("detect coincident:n=60 --plan --json" + options).output);
    for (const auto& step : line["plan"])
      if (step["step"] == "pair list") return !step["left_out"].get<bool>();
    ADD_FAILURE() << "no word of pairs";
    return false;
  };
  EXPECT_FALSE(kept(""));
  EXPECT_TRUE(kept(" --pairs '" + file("p.csv") + "'"));
  EXPECT_TRUE(kept(" --pair-limit 900"));
  EXPECT_FALSE(kept(" --counts '" + file("c.csv") + "'"));
}

TEST_F(Program, PrintsTheFrameItUsed) {
  expect_says("detect path1:n=100,frame=3", 0, {"frame 3: 100 spheres"});
  EXPECT_EQ(nlohmann::json::parse(run("detect path1:n=100,frame=3 --json").output)["frame"], 3);
  EXPECT_EQ(nlohmann::json::parse(run("verify path1:n=100,frame=3 --variant CPU1 --json").output)["frame"],
            3);
  EXPECT_EQ(nlohmann::json::parse(run("margins path1:n=100,frame=3 --json").output)["frame"], 3);
  const std::string pairs = file("p.csv");
  expect_says("detect path1:n=1000,frame=28 --pairs '" + pairs + "'", 0, {"frame 28"});
  EXPECT_TRUE(text_of(pairs).starts_with("frame,i,j,label_i,label_j,strand_i,strand_j,index_i,index_j\n28,"))
      << text_of(pairs).substr(0, 40);
}

TEST_F(Program, LeavesOutWhatATolerancePermits) {
  const std::string dense = "detect path1:n=5000,spacing=0.2,frame=3 ";
  expect_says(dense + "--tolerance 0.1 --arc-window pi/2", 0,
              {"of 5000 spheres are kept; without the others", "auto"});
  expect_says(dense + "--tolerance 0.1 --arc-window pi/2 --json", 0,
              {"\"thinned\":{\"tolerance\":0.1,\"of\":5000"});
  expect_says("verify path2:n=600,spacing=0.3 --tolerance 0.1 --arc-window pi/2 --variant Hybrid", 0,
              {"exact"});
  expect_says("detect " + examples + "melt.dump --radius 0.5 --tolerance 0.3 --arc-window 1.5", 0,
              {"every sphere is kept", "4 spheres, 2 pairs"});
  expect_refused(dense + "--tolerance 0.1", "give --arc-window F too");
  expect_refused(dense + "--tolerance 1 --arc-window pi/2", "above 0 and below 1");
  expect_refused(dense + "--tolerance wide --arc-window pi/2", "--tolerance");
}

}  // namespace
}  // namespace catena
