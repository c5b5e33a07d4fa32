#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "catena/bench/enumerate/judge.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena enumerate`, held against the walks that it counts.
class EnumerateProgram : public Program {
 protected:
  void expect_told(const std::string& options, const std::vector<WalkQuestion>& questions) const {
    const ProgramOutcome told = run("enumerate --variant CPU1 --json " + options);
    EXPECT_EQ(told.code, 0) << told.output;
    std::istringstream lines(told.output);
    std::string line;
    for (const WalkQuestion& question : questions)
      for (const WalkVerdict& verdict : judge_walks(*StrategyRegistry::instance().make("CPU1"), question)) {
        ASSERT_TRUE(std::getline(lines, line)) << options;
        const auto json = nlohmann::json::parse(line);
        EXPECT_EQ(json["lattice"], lattice_name(question));
        EXPECT_EQ(json["radius"], question.radius) << options;
        EXPECT_EQ(json["steps"], verdict.steps);
        EXPECT_EQ(json["counts"], verdict.counts);
        EXPECT_EQ(json["found"], verdict.found) << line;
        for (const char* key : {"published", "sequence", "agrees"})
          EXPECT_EQ(json.contains(key), verdict.published.has_value()) << line;
        if (!verdict.published) continue;
        EXPECT_EQ(json["published"], *verdict.published);
        EXPECT_EQ(json["sequence"], verdict.sequence);
        EXPECT_EQ(json["agrees"], true);
      }
    EXPECT_FALSE(std::getline(lines, line)) << line;
  }
};

TEST_F(EnumerateProgram, CountsWhatIsAsked) {
  const float below = std::nextafter(0.5f, 0.0f);
  expect_told("--walks 4", {{3, below, true, 4}, {3, 0.5f, false, 4}});
  expect_told("--walks 4 --lattice square", {{2, below, true, 4}, {2, 0.5f, false, 4}});
  for (const std::string lattice : {"square", "cubic", "diamond"})
    expect_says("enumerate --walks 2 --json --lattice " + lattice, 0, {"{\"lattice\":\"" + lattice + "\""});
  expect_told("--walks 3 --radius 0.8", {{3, 0.8f, false, 3}});
  const OtherLattice& diamond = *other_lattice("diamond");
  expect_told("--walks 3 --lattice diamond", {{.radius = below, .steps = 3, .other = &diamond}});
  expect_told("--walks 3 --lattice diamond --radius 1", {{.radius = 1, .steps = 3, .other = &diamond}});
}

TEST_F(EnumerateProgram, HeadsEachTableByWhatItCounts) {
  const std::string variant = " --variant CPU1", told = run("enumerate --walks 3" + variant).output;
  std::istringstream lines(run("enumerate --walks 3 --json" + variant).output);
  std::set<std::string> heads;
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    heads.insert(fmt::format("radius {:.9g}, CPU1: {}", json["radius"].get<float>(),
                             json["counts"].get<std::string>()));
  }
  EXPECT_EQ(heads.size(), 3u);
  for (const std::string& head : heads) {
    const std::size_t at = told.find(head);
    ASSERT_NE(at, std::string::npos) << head;
    EXPECT_EQ(told.find(head, at + 1), std::string::npos) << head << " twice";
  }
}

TEST_F(EnumerateProgram, SaysWhatIsNotPublishedAndWhatDiffers) {
  expect_says("enumerate --walks 2 --radius 0.8", 0,
              {"no table to compare with", "      2                    6                    -\n"});
  expect_says("enumerate --walks 3 --lattice diamond", 0,
              {"diamond lattice, radius 0.49999997, ", "A001394"});
  expect_says("enumerate --walks 2 --lattice triangular --radius 0.6", 0,
              {"radius 0.600000024, ", "no table", "      2                   18                    -\n"});
  expect_refused("enumerate --walks 2 --lattice honeycomb --radius 0.6",
                 "on the honeycomb lattice a radius must be below 1/2");
  const std::string wrong = "enumerate --walks 3 --variant mutant:less-for-less-equal";
  expect_says(wrong, 1, {"  DIFFERS"});
  expect_says(wrong + " --json", 1, {"\"agrees\":false"});
}

}  // namespace
}  // namespace catena::bench
