#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/bench/stability/report.h"
#include "catena/bench/stability/run.h"
#include "catena/core/commands/test_program.h"

namespace catena::bench {
namespace {

/// `catena stability`, held against the cells that it measured.
class StabilityProgram : public Program {};

TEST_F(StabilityProgram, TellsEveryCell) {
  const std::vector<std::string> scenes{"coincident:n=100", "lattice:n=100"},
      variants{"aCPU2+CPU2/literal", "CPU1", "bGPU2@host+CPU2"};
  const ProgramOutcome told =
      run("stability coincident:n=100 lattice:n=100 --variant aCPU2+CPU2/literal --variant CPU1 --variant "
          "bGPU2@host+CPU2 "
          "--json");
  EXPECT_EQ(told.code, 0) << told.output;
  std::istringstream lines(told.output);
  std::string line;
  for (const auto& scene : scenes)
    for (const Cell& cell : measure_scene(scene, variants)) {
      ASSERT_TRUE(std::getline(lines, line));
      const auto json = nlohmann::json::parse(line);
      EXPECT_EQ(json, nlohmann::json(to_json(cell)));
      const auto& v = cell.found;
      EXPECT_EQ(json["scene"], scene);
      EXPECT_EQ(json["n"], 100);
      EXPECT_EQ(json["exact_pairs"], cell.exact_pairs);
      EXPECT_EQ(json["missing"], v.comparison.missing);
      EXPECT_EQ(json["invented"], v.comparison.invented);
      EXPECT_EQ(json["wrong_counts"], v.comparison.wrong_counts);
      EXPECT_EQ(json["bounds"], v.enclosure.bounds);
      EXPECT_EQ(json["unenclosed"], v.enclosure.violations);
      EXPECT_EQ(json["worst_margin"], std::isfinite(v.comparison.worst_margin)
                                          ? nlohmann::json(v.comparison.worst_margin)
                                          : nlohmann::json("infinite"));
      EXPECT_EQ(json["worst_shortfall"], std::isfinite(v.enclosure.worst_shortfall)
                                             ? nlohmann::json(v.enclosure.worst_shortfall)
                                             : nlohmann::json("infinite"));
      EXPECT_EQ(json.contains("reason"), !v.reason.empty());
    }
}

TEST_F(StabilityProgram, ShowsATableOrItsCells) {
  const std::string scene = "stability lattice:n=100 --variant CPU1 --variant mutant:less-for-less-equal ";
  expect_says(scene, 1,
              {"scene", "The worst variant of each arithmetic",
               "DEFECT: mutant:less-for-less-equal on lattice:n=100"});
  const std::string cells = run(scene + "--cells").output;
  EXPECT_NE(cells.find("DEFECT wrong"), std::string::npos) << cells;
  EXPECT_EQ(cells.find("The worst variant"), std::string::npos) << cells;
  EXPECT_EQ(run("stability lattice:n=100 --variant CPU1").code, 0);
}

TEST_F(StabilityProgram, HasScenesOfTheSizeThatIsAsked) {
  std::set<std::string> sized;
  for (const auto& scene : stability_scenes(30)) sized.insert(scene);
  std::istringstream lines(run("stability --n 30 --variant CPU1 --json").output);
  std::set<std::string> told;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('{')) told.insert(nlohmann::json::parse(line)["scene"].get<std::string>());
  EXPECT_EQ(told, sized);
  expect_refused("stability lattice:n=100 --n 30", "--n sizes the scenes of the full matrix");
  expect_says("stability coincident:n=300 --overlaps 10 --variant CPU1", 2,
              {"overlapping spheres, neighbours included; see --overlaps", "nothing was measured"});
  expect_says("stability rod:n=60000 --variant CPU1", 2, {"O(n^2)", "nothing was measured"});
}

}  // namespace
}  // namespace catena::bench
