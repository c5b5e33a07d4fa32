#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "catena/bench/tube/error.h"
#include "catena/bench/work_precision/json.h"
#include "catena/bench/work_precision/work_precision.h"
#include "catena/core/commands/test_program.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// Each number of a point under its own key, and who beats it by its place among all.
TEST(WorkPrecisionJson, HasEveryNumberUnderItsKey) {
  WorkPrecision result;
  result.left_out = {"A: too long", "B: too long"};
  Point p{.tube = "helix",
          .variant = "A",
          .arithmetic = "literal",
          .n = 9,
          .tube_error = 0.5,
          .stored_error = 0.25,
          .repetitions = 3,
          .tolerance = 0.125,
          .offset = 7};
  p.answer_error = 0.75, p.exact_pairs = 11, p.missing = 2, p.invented = 3, p.worst_margin = 0.375,
  p.depth_error = 0.625;
  p.time = {1, 2, 4, 8};
  result.points = {p, p};
  result.points[1].tolerance.reset(), result.points[1].dominated_by = 0;
  result.points[1].worst_margin = std::numeric_limits<double>::infinity();
  const nlohmann::ordered_json first{{"tube", "helix"},
                                     {"offset", 7.0},
                                     {"n", 9},
                                     {"variant", "A"},
                                     {"arithmetic", "literal"},
                                     {"tube_error", 0.5},
                                     {"stored_error", 0.25},
                                     {"answer_error", 0.75},
                                     {"exact_pairs", 11},
                                     {"missing", 2},
                                     {"invented", 3},
                                     {"worst_margin", 0.375},
                                     {"depth_error", 0.625},
                                     {"repetitions", 3},
                                     {"least_ms", 1.0},
                                     {"lower_quartile_ms", 2.0},
                                     {"median_ms", 4.0},
                                     {"upper_quartile_ms", 8.0},
                                     {"front", true},
                                     {"tolerance", 0.125}};
  nlohmann::ordered_json second = first;
  second.erase("tolerance");
  second["worst_margin"] = "infinite", second["front"] = false, second["dominated_by"] = 0;
  nlohmann::ordered_json out;
  add_to_json(out, result);
  EXPECT_EQ(out["points"], (nlohmann::ordered_json{first, second}));
  add_to_json(out, result);
  second["dominated_by"] = 2;
  EXPECT_EQ(out["points"][3], second);
  EXPECT_EQ(out["left_out"], (nlohmann::ordered_json{"A: too long", "B: too long"})) << "each once";
}

/// All in radii of the tube, of whatever radius it is; what a variant refuses is left out with its reason.
TEST(WorkPrecision, IsInRadiiAndSaysWhatWasRefused) {
  Tube thick = straight_rod(), thin = thick;
  thick.radius = 4, thick.length *= 4;
  const auto of = [](const Tube& tube) {
    return work_precision(tube, {20}, {"CPU1"}, 1, 0x1p18 * tube.radius, {0.1}).points;
  };
  const auto one = of(thin), four = of(thick);
  ASSERT_EQ(one.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(one[k].n, four[k].n);
    EXPECT_NEAR(one[k].tube_error, four[k].tube_error, 1e-9);
    EXPECT_NEAR(one[k].stored_error, four[k].stored_error, 1e-9);
    EXPECT_EQ(one[k].tolerance, k == 0 ? std::nullopt : std::optional(0.1));
  }
  EXPECT_GT(one[0].stored_error, 0);
  const auto refused = work_precision(straight_rod(), {2000}, {"bGPU2@host+CPU2"}, 1);
  EXPECT_TRUE(refused.points.empty());
  ASSERT_EQ(refused.left_out.size(), 1u);
  EXPECT_NE(refused.left_out[0].find("bGPU2@host+CPU2: "), std::string::npos);
  EXPECT_NE(refused.left_out[0].find("at most 1536"), std::string::npos) << refused.left_out[0];
}

class WorkPrecisionProgram : public Program {
 protected:
  void SetUp() override {
    if (!measures_in_this_build()) GTEST_SKIP() << "measures in a Release build only";
  }
  nlohmann::json points(const std::string& options) const {
    const ProgramOutcome told =
        run("work-precision straight_rod --offset 0 --variant CPU1 --repetitions 1 --json " + options);
    EXPECT_EQ(told.code, 0) << told.output;
    return nlohmann::json::parse(told.output)["points"];
  }
};

TEST_F(WorkPrecisionProgram, MeasuresTheSizesAndTolerancesThatAreAsked) {
  const auto sizes = [&](const std::string& options) {
    std::vector<std::pair<std::uint32_t, double>> found;  // tolerance 0: none
    for (const auto& p : points(options)) found.emplace_back(p["n"], p.value("tolerance", 0.0));
    return found;
  };
  using Sizes = std::vector<std::pair<std::uint32_t, double>>;
  EXPECT_EQ(sizes("--n 20 --n 40"), (Sizes{{20, 0}, {40, 0}}));
  const std::uint32_t tenth = spheres_for(straight_rod(), 0.1), hundredth = spheres_for(straight_rod(), 0.01);
  EXPECT_EQ(sizes("--n 20 --tolerance 0.1"), (Sizes{{20, 0}, {tenth, 0.1}}));
  // A length of 40 in spacings from 2 to 1/16.
  EXPECT_EQ(sizes(""), (Sizes{{20, 0}, {40, 0}, {80, 0}, {160, 0}, {320, 0}, {640, 0}, {hundredth, 0.01}}));
}

/// Where nobody can be asked, or all was left out, nothing was measured, and that is no success.
TEST_F(WorkPrecisionProgram, MeasuresNothingByNobody) {
  expect_says("work-precision straight_rod --n 6000 --repetitions 1 --variant CPU1", 2,
              {"nothing was measured"});
  for (const VariantInfo& info : StrategyRegistry::instance().variants())
    if (info.unavailable) {
      expect_refused("work-precision --n 50 --variant '" + info.name + "'",
                     info.name + " is not available here: ");
      break;
    }
}

TEST_F(WorkPrecisionProgram, NamesWhoBeatsAPoint) {
  const std::string text = run("work-precision straight_rod --offset 0 --n 3000 --n 100 --variant CPU1 "
                               "--variant Grid --variant aCPU2+CPU2 --repetitions 5")
                               .output;
  std::istringstream lines(text);
  std::set<std::string> there, better;  // "Grid, n = 3000"
  int beaten = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string n, variant;
    words >> n >> variant;
    if (variant == "CPU1" || variant == "Grid" || variant == "aCPU2+CPU2")
      there.insert(variant + ", n = " + n);
    const std::string by = "dominated by ";
    if (const auto at = line.find(by); at != std::string::npos) {
      better.insert(line.substr(at + by.size()));
      ++beaten;
      EXPECT_EQ(line.substr(line.rfind(' ') + 1), n)
          << "fewer spheres make a greater error, and here no more take less";
    }
  }
  EXPECT_EQ(there.size(), 6u) << text;
  EXPECT_FALSE(better.empty()) << text;
  EXPECT_NE(text.find(std::to_string(6 - beaten) + " of 6 points are on the Pareto front"), std::string::npos)
      << text;
  for (const std::string& name : better) EXPECT_TRUE(there.contains(name)) << name;
}

}  // namespace
}  // namespace catena::bench
