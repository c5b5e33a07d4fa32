#include <nlohmann/json.hpp>

#include "catena/bench/closed_form/lattice_box.h"
#include "catena/core/commands/test_program.h"

namespace catena::bench {
namespace {

class ClosedFormProgram : public Program {};

TEST_F(ClosedFormProgram, TellsWhatTheFormulaKnows) {
  const LatticeBox box{.side = 9, .reach = 3};
  const ProgramOutcome told = run("closed-form --side 9 --reach 3 --variant CPU1 --json");
  EXPECT_EQ(told.code, 0) << told.output;
  const auto line = nlohmann::json::parse(told.output);
  EXPECT_EQ(line["n"], box.spheres());
  EXPECT_EQ(line["pairs"], box.pairs());
  EXPECT_EQ(line["closed_form"], box.pairs());
  EXPECT_EQ(line["ties"], box.ties());
  EXPECT_NE(box.ties(), box.pairs());
  EXPECT_EQ(line["fault"], "");
  EXPECT_LT(line["build_ms"], line["find_ms"]) << "all pairs build nothing";
}

TEST_F(ClosedFormProgram, EndsWith1ForAWrongAnswer) {
  const LatticeBox box{.side = 5, .reach = 2};
  const std::string wrong = "closed-form --side 5 --reach 2 --variant mutant:less-for-less-equal";
  const ProgramOutcome told = run(wrong + " --json");
  EXPECT_EQ(told.code, 1) << told.output;
  const auto line = nlohmann::json::parse(told.output);
  EXPECT_EQ(line["closed_form"], box.pairs());
  EXPECT_EQ(line["pairs"], box.pairs() - box.ties());
  EXPECT_NE(line["fault"], "");
  expect_says(wrong, 1, {"WRONG: "});
}

}  // namespace
}  // namespace catena::bench
