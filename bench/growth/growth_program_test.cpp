#include <nlohmann/json.hpp>
#include <sstream>

#include "catena/bench/growth/growth.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

class GrowthProgram : public Program {};

TEST_F(GrowthProgram, TellsTheLawThatItFitted) {
  const ProgramOutcome told = run("growth yarn --n 32000 --variant aCPU2+Dual --variant Necklace --json");
  EXPECT_EQ(told.code, 0) << told.output;
  std::istringstream lines(told.output);
  std::string line;
  for (const char* name : {"aCPU2+Dual", "Necklace"}) {
    ASSERT_TRUE(std::getline(lines, line));
    const Growth growth = measure_growth("yarn", StrategyRegistry::instance().describe(name), 32'000);
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["variant"], name);
    ASSERT_EQ(json["points"].size(), 4u) << "1000 to 31623 in half decades";
    EXPECT_EQ(json["points"][0]["n"], 1000);
    EXPECT_EQ(json["points"][3]["n"], 31623);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(json["points"][k]["node_pairs"], growth.points[k].node_pairs);
    EXPECT_EQ(json["exponent"], growth.law().exponent);
    EXPECT_EQ(json["low"], growth.law().low);
    EXPECT_EQ(json["high"], growth.law().high);
    EXPECT_EQ(json["plain"]["exponent"], growth.plain_power().exponent);
    EXPECT_EQ(json["plain"]["low"], growth.plain_power().low);
    EXPECT_EQ(json["plain"]["high"], growth.plain_power().high);
    EXPECT_EQ(json["within_four_thirds"], growth.law().low <= 4.0 / 3);
  }
}

TEST_F(GrowthProgram, SaysWhatIsAboveTheLaw) {
  expect_says("growth yarn --n 32000 --variant CPU1", 0,
              {"ABOVE", "      1000         498501     498.5 a sphere"});
  EXPECT_EQ(
      nlohmann::json::parse(run("growth yarn --n 32000 --variant CPU1 --json").output)["within_four_thirds"],
      false);
  expect_says("growth yarn --n 32000 --variant Necklace", 0, {"within"});
  expect_refused("growth yarn --n 3e9", "--n must be below 2^31");
}

}  // namespace
}  // namespace catena::bench
