#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/bench/regret/regret.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena regret`, each of its figures against the others.
class RegretProgram : public Program {
 protected:
  const std::string little = "--seconds 0.01 --rounds 3 ";
};

TEST_F(RegretProgram, SumsUpItsLines) {
  const std::string text =
      run("regret path1:n=300 yarn:n=900 rod:n=40 " + little + "--variant CPU1 --variant aCPU2+CPU2").output;
  std::istringstream lines(text);
  std::string line, at_once, later;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("input")) << text;
  std::vector<double> ratios, settled;
  while (std::getline(lines, line)) {
    if (line.starts_with("at once:")) at_once = line;
    if (line.starts_with("later:")) later = line;
    std::istringstream words(line);
    std::string input, first, best, chosen;
    double auto_ms = 0, best_ms = 0, ratio = 0, settled_ratio = 0;
    if (!(words >> input >> first >> best >> auto_ms >> best_ms >> ratio >> settled_ratio >> chosen))
      continue;
    ratios.push_back(ratio), settled.push_back(settled_ratio);
    EXPECT_TRUE(best == "CPU1" || best == "aCPU2+CPU2") << line;
    EXPECT_NEAR(ratio, auto_ms / best_ms, 1e-3 * ratio + 1e-3) << line;
  }
  const auto expect_sum = [&](const std::string& end, const std::string& when,
                              const std::vector<double>& of) {
    ASSERT_EQ(of.size(), 3u) << text;
    double mean = 0, most = 0, above = 0, all = 0;
    ASSERT_EQ(std::sscanf(end.c_str(),
                          (when + ": geometric mean %lf, the most %lf; above 1.05: %lf of %lf").c_str(),
                          &mean, &most, &above, &all),
              4)
        << text;
    double logs = 0, rounded = 6e-4 / mean;
    for (const double ratio : of) logs += std::log(ratio) / 3, rounded += 6e-4 / ratio;
    EXPECT_NEAR(std::log(mean), logs, rounded);
    EXPECT_EQ(most, std::ranges::max(of));
    EXPECT_EQ(all, 3);
    EXPECT_GE(above, std::ranges::count_if(of, [](double r) { return r > 1.051; }));
    EXPECT_LE(above, std::ranges::count_if(of, [](double r) { return r > 1.049; }));
  };
  expect_sum(at_once, "at once", ratios);
  expect_sum(later, "later", settled);
}

TEST_F(RegretProgram, TakesInputsOrSizesAndSaysWhatIsLeftOut) {
  expect_refused("regret path1:n=300 --n 5", "--n sizes the scenes when no input is named");
  for (const VariantInfo& info : StrategyRegistry::instance().variants())
    if (info.unavailable) {
      expect_refused("regret path1:n=300 --variant '" + info.name + "'", " is not available here: ");
      break;
    }
  std::filesystem::create_directories(file("b"));
  const std::string chain = "catena-chain 1\nwindow 1\nstrand open 1\n0 0 0 1\nend\n";
  expect_refused("regret '" + write("x.chain", chain) + "' '" + write("b/x.chain", chain) + "'",
                 "have one name without their folders");
  expect_refused("regret yarn:n=100,radius=nan path1:n=1e400", "yarn: radius=nan must be a number");
  expect_refused("regret yarn:n=5000 --variant CPU1", "yarn/n:5000 is left out: no other variant takes it");
  expect_says("regret yarn:n=5000 yarn:n=6000 --variant CPU1", 2, {"nothing was measured"});
  const ProgramOutcome left = run("regret winding:n=300000 rod:n=40 " + little + "--variant CPU1 --json");
  EXPECT_EQ(left.code, 0) << left.output;
  EXPECT_NE(left.output.find("catena regret: winding/n:300000 is left out: "), std::string::npos)
      << left.output;
  EXPECT_EQ(std::ranges::count(left.output, '{'), 1) << left.output;
  // What is said of a file is heeded: without radii it cannot be searched.
  const std::string line = write("a.xyz", "3\n\nA 0 0 0\nA 2 0 0\nA 4 0 0\n");
  expect_refused("regret " + line + " " + little + "--variant CPU1", "radi");
  const ProgramOutcome told = run("regret " + line + " --radius 1 --json " + little + "--variant CPU1");
  EXPECT_EQ(told.code, 0) << told.output;
  EXPECT_EQ(nlohmann::json::parse(told.output)["input"], "a.xyz:radius=1/n:3") << told.output;
}

}  // namespace
}  // namespace catena::bench
