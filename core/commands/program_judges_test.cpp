// How the program judges variants, walks and knots, and finds chains that break a property.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/commands/test_program.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

using Outcome = ProgramOutcome;

TEST_F(Program, VerifiesByReferenceAndByCertificate) {
  expect_says("verify coincident:n=60 path1:n=200", 0, {"aCPU2+CPU2", "CPU1", "exact"});
  const Outcome right = run("verify coincident:n=60 path1:n=200");
  EXPECT_TRUE(right.output.starts_with("Every exact variant is exact, on 2 inputs: ")) << right.output;
  // How many arithmetics and reasons there are depends on what was built in; each has one table or line of
  // its own, and a table has few answers to an input, whatever the number of variants.
  const auto lines_that_begin = [&](const std::string& words) {
    std::istringstream lines(right.output);
    std::set<std::string> distinct;
    std::size_t found = 0;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(words)) ++found, distinct.insert(line.substr(0, line.find(": ")));
    return std::pair{found, distinct.size()};
  };
  const std::size_t tables = lines_that_begin("  input ").first;
  EXPECT_GE(tables, 3u) << right.output;
  EXPECT_LE(lines_that_begin("  coincident:n=60 ").first, 2 * tables) << right.output;
  const auto [absent, reasons] = lines_that_begin("not available here, ");
  EXPECT_EQ(absent, reasons) << right.output;
  const Outcome wrong = run("verify lattice:n=60 --variant mutant:less-for-less-equal --variant CPU1");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_TRUE(wrong.output.starts_with("mutant:less-for-less-equal on lattice:n=60: WRONG")) << wrong.output;
  EXPECT_NE(wrong.output.find("NOT every exact variant is exact. Wrong: mutant:less-for-less-equal\n"),
            std::string::npos)
      << wrong.output;
  expect_says("verify coincident:n=60 --variant Nothing", 2, {"Nothing"});
  expect_says("verify coincident:n=60 --variant aCPU2+Dual --certify", 0, {"certified"});
  expect_says("verify coincident:n=60 --variant mutant:less-for-less-equal lattice:n=60", 1, {"missing"});
  std::istringstream lines(
      run("verify coincident:n=60 --variant aCPU2+CPU2/literal --variant CPU1 --json").output);
  std::vector<nlohmann::json> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["verdict"], "differs");
  EXPECT_EQ(rows[0]["missing"], 812);
  EXPECT_EQ(rows[1]["verdict"], "exact");
}

// Where nobody can be asked, nothing was verified, and that is no success.
TEST_F(Program, VerifiesNothingByNobody) {
  const auto& variants = StrategyRegistry::instance().variants();
  const auto absent =
      std::ranges::find_if(variants, [](const VariantInfo& v) { return v.unavailable.has_value(); });
  if (absent == variants.end()) GTEST_SKIP() << "every variant is available here";
  expect_refused("verify path1:n=50 --variant '" + absent->name + "'",
                 absent->name + " is not available here: ");
  for (const std::string command : {"stability yarn:n=50", "regret yarn:n=50"})
    expect_refused(command + " --variant '" + absent->name + "'", absent->name + " is not available here: ");
  expect_says("verify path1:n=50 --variant CPU1 --variant '" + absent->name + "'", 0,
              {"CPU1", "1 unavailable"});
}

TEST_F(Program, FuzzFindsStoresAndReplays) {
  const std::string failures = file("failures");
  expect_says("fuzz --cases 30", 0, {"30 chains", "no finding", "deepest tree"});
  expect_says("fuzz --variant CPU1 --seconds 0.2 --scene-family coil", 0, {"coil", "no finding"});
  expect_says("fuzz --variant mutant:less-for-less-equal --cases 2000 --failures '" + failures + "'", 1,
              {"FOUND by case", "catena-chain 1", "run it again"});
  std::string stored;
  for (const auto& entry : std::filesystem::directory_iterator(failures)) stored = entry.path().string();
  ASSERT_FALSE(stored.empty());
  expect_says("fuzz --replay '" + stored + "'", 0, {"every property holds"});
  expect_says("fuzz --replay '" + stored + "' --variant mutant:less-for-less-equal", 1, {"pair set"});
}

TEST_F(Program, CountsAndTurnsWalks) {
  expect_says("pivot --n 40 --moves 64 --rotations any", 0,
              {"40 points", "self-avoiding by the exact reference"});
  expect_says("pivot --n 40 --moves 64 --at-once", 0, {"\n1 at once", "\n39 at once", "times as much"});
  expect_says(
      "pivot --n 100 --moves 64 --exponent", 0,
      {"3 points: ", "\n6 points: ", "\n12 points: ", "\n25 points: ", "\n50 points: ", "\n100 points: "});
  expect_says("enumerate --walks 4 --lattice diamond", 0, {"A001394", "108"});
}

TEST_F(Program, JudgesKnotsByWhatWasPublishedOfThem) {
  expect_says("knots --n 32", 0, {"hopf: the tight Hopf link", "published  ropelength 25.13", "within"});
  const std::string trefoil = "knots tight_knot:p=2,margin=0,n=600 ";
  expect_says(trefoil + "--knot 3_1", 0, {"within"});
  expect_says(trefoil + "--ropelength 60", 1, {"NOT WITHIN: ", "fit in, above"});
  expect_says(trefoil + "--ropelength 20 --variant CPU1", 1, {"NOT WITHIN: ", "touch at a radius of"});
  expect_says(trefoil + "--thickness 1e-3", 1, {"NOT WITHIN: ", "do not touch"});
  expect_says("knots tight_knot:p=2,margin=0,n=64 --knot 3_1_328", 1,
              {", 375 struts", "struts     are of its shape 100 steps of tightening later"});
  expect_says("knots " + examples + "9_47-cubiclattice.txt --closed --knot knotted", 0,
              {"208 vertices", "within"});
}

}  // namespace
}  // namespace catena
