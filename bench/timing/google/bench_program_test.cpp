#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "catena/core/commands/test_program.h"
#include "catena/core/commands/variant_json.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

class BenchProgram : public Program {
 protected:
  void SetUp() override {
    if (!measures_in_this_build()) GTEST_SKIP() << "measures in a Release build only";
  }
  /// Runs catena_bench, which lies beside catena; its exit code.
  int measure(const std::string& options) const {
    const auto program = std::filesystem::path(CATENA_PROGRAM).parent_path() / "catena_bench";
    return shell("'" + program.string() +
                 "' --scene path1 --n 300 --benchmark_filter=/aCPU2.Dual/find --benchmark_min_time=0.001 " +
                 options + " > /dev/null")
        .code;
  }
};

TEST_F(BenchProgram, WritesARunFileThatDescribesItsVariants) {
  ASSERT_EQ(measure("--benchmark_out='" + file("run.json") + "'"), 0);
  const auto run = nlohmann::ordered_json::parse(text_of(file("run.json")));
  ASSERT_EQ(run["benchmarks"].size(), 1u);
  EXPECT_EQ(run["catena"]["variants"]["aCPU2+Dual"],
            to_json(StrategyRegistry::instance().describe("aCPU2+Dual")));
  EXPECT_TRUE(run["context"].contains("commit"));

  EXPECT_EQ(measure("--nonsense=1"), 2);
  EXPECT_EQ(measure("--benchmark_filter=nothing"), 2) << "nothing was measured";
  EXPECT_EQ(measure("--help"), 0);

  // Spreads of what is always 0 are no numbers.
  ASSERT_EQ(measure("--benchmark_repetitions=2 --benchmark_out='" + file("spread.json") + "'"), 0);
  const std::string spread = text_of(file("spread.json"));
  EXPECT_NE(spread.find("NaN"), std::string::npos);
  EXPECT_NE(spread.find("\"catena\": {\"schema\":1,"), std::string::npos);

  ASSERT_EQ(measure("--benchmark_out_format=csv --benchmark_out='" + file("run.csv") + "'"), 0);
  EXPECT_NE(text_of(file("run.csv")).find("aCPU2+Dual/find"), std::string::npos);
  EXPECT_EQ(text_of(file("run.csv")).find("catena\":"), std::string::npos);
}

TEST_F(BenchProgram, SaysItsOwnOptionsBesideGoogles) {
  const auto program = std::filesystem::path(CATENA_PROGRAM).parent_path() / "catena_bench";
  const std::string help = shell("'" + program.string() + "' --help > '" + file("out") + "'").output;
  for (const std::string option :
       {"Usage: catena_bench", "--scene", "--n ", "--flush-cache", "--radius R", "--benchmark_filter="})
    EXPECT_NE(help.find(option), std::string::npos) << option << help;
}

/// A scene with n as it is, one without at every size; of all scenes those that strain nothing.
TEST_F(BenchProgram, MeasuresEveryInputAtItsSizes) {
  const auto labels = [&](const std::string& options) {
    const auto program = std::filesystem::path(CATENA_PROGRAM).parent_path() / "catena_bench";
    std::set<std::string> found;
    std::istringstream lines(shell("'" + program.string() +
                                   "' --benchmark_list_tests --benchmark_filter=/CPU1/find " + options +
                                   " > '" + file("out") + "'")
                                 .output);
    for (std::string line; std::getline(lines, line);) found.insert(line.substr(0, line.find("/CPU1/")));
    return found;
  };
  using Labels = std::set<std::string>;
  EXPECT_EQ(
      labels("--scene path1:n=70 --scene yarn:seed=2,n=80 --scene rod --scene yarn:seed=2 --n 50 --n 60"),
      (Labels{"path1/n:70", "yarn:seed=2/n:80", "rod/n:50", "rod/n:60", "yarn:seed=2/n:50",
              "yarn:seed=2/n:60"}));
  EXPECT_EQ(labels("--scene serpentine:side=6 --n 50 --n 60"), (Labels{"serpentine:side=6/n:216"}));
  Labels ordinary;
  for (const SceneInfo& scene : SceneRegistry::instance().scenes())
    if (scene.strains.empty() && scene.name != "rope") ordinary.insert(scene.name + "/n:40");
  Labels all = labels("--n 40");
  all.erase("rope/n:40");
  EXPECT_EQ(all, ordinary);
  const std::string line = write("a.xyz", "3\n\nA 0 0 0\nA 2 0 0\nA 4 0 0\n");
  EXPECT_EQ(labels("--radius 1 --scene " + line), (Labels{"a.xyz:radius=1/n:3"}));
}

}  // namespace
}  // namespace catena
