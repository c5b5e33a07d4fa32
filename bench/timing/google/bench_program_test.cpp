#include <nlohmann/json.hpp>

#include "catena/core/commands/test_program.h"
#include "catena/core/commands/variant_json.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

class BenchProgram : public Program {
 protected:
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
  EXPECT_EQ(measure("--help"), 0) << "Google Benchmark's";

  // Spreads of what is always 0 are no numbers.
  ASSERT_EQ(measure("--benchmark_repetitions=2 --benchmark_out='" + file("spread.json") + "'"), 0);
  const std::string spread = text_of(file("spread.json"));
  EXPECT_NE(spread.find("NaN"), std::string::npos);
  EXPECT_NE(spread.find("\"catena\": {\"schema\":1,"), std::string::npos);

  ASSERT_EQ(measure("--benchmark_out_format=csv --benchmark_out='" + file("run.csv") + "'"), 0);
  EXPECT_NE(text_of(file("run.csv")).find("aCPU2+Dual/find"), std::string::npos);
}

}  // namespace
}  // namespace catena
