#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/stability/cell.h"
#include "catena/bench/stability/report.h"
#include "catena/bench/stability/run.h"
#include "catena/core/input/input.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/exact_gap.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

Cell cell_of(const std::string& scene, const std::string& variant) {
  const Chain chain = open_input(scene).animation->frame(0);
  const auto& registry = StrategyRegistry::instance();
  return measure(scene, registry.describe(variant), *registry.make(variant), chain, reference::find(chain));
}

TEST(Stability, TellsTheOutcomesApart) {
  EXPECT_EQ(cell_of("lattice:n=500", "aCPU2+CPU2").outcome, Outcome::exact);
  EXPECT_EQ(cell_of("rod:n=2000", "aCPU2+CPU2/literal").outcome, Outcome::unenclosed);
  EXPECT_EQ(cell_of("grazing:n=2000,margin=0", "CPU1/literal").outcome, Outcome::wrong);
  EXPECT_EQ(cell_of("coincident:n=500", "aCPU2+CPU2/literal").outcome, Outcome::not_finite);
  EXPECT_EQ(cell_of("rod:n=2000", "bGPU2@host+CPU2").outcome, Outcome::refused);
}

TEST(Stability, OnlyRoundedArithmeticMayBeWrong) {
  for (const char* scene :
       {"grazing:n=2000,margin=0", "coincident:n=500", "largest:n=500", "smallest:n=500"}) {
    EXPECT_FALSE(cell_of(scene, "aCPU2+CPU2/literal").defect) << scene;
    const Cell robust = cell_of(scene, "aCPU2+CPU2");
    EXPECT_EQ(robust.outcome, Outcome::exact) << scene << ": " << robust.found.reason;
    EXPECT_FALSE(robust.defect);
  }
}

/// Answers nothing at all.
class Silent final : public Variant {
 public:
  void build(const Chain&) override {}
  void find(const Chain& chain, const Request&, Collisions& result) override {
    result = {false, 0, std::vector<std::uint32_t>(chain.size()), {}};
  }
  Timings timings() const override { return {}; }
};

TEST(Stability, ARobustVariantThatMissesAPairIsADefect) {
  const Chain chain = open_input("lattice:n=100").animation->frame(0);
  Silent silent;
  VariantInfo info;
  info.name = "Silent", info.arithmetic = "robust";
  const Cell cell = measure("lattice", info, silent, chain, reference::find(chain));
  EXPECT_TRUE(cell.defect);
  EXPECT_EQ(cell.outcome, Outcome::wrong);
  EXPECT_EQ(cell.found.comparison.missing, cell.exact_pairs);
  StabilityReport report(StabilityReport::Form::json, {"lattice"}, {"Silent"}, {"robust"});
  testing::internal::CaptureStdout();
  report.scene({cell});
  const auto line = nlohmann::json::parse(testing::internal::GetCapturedStdout());
  EXPECT_TRUE(report.any_defect());
  EXPECT_EQ(line["outcome"], "wrong");
  EXPECT_EQ(line["missing"], cell.exact_pairs);
  EXPECT_EQ(line["not_finite_nodes"], 0);
}

TEST(Stability, RunsEverySceneInEverySetting) {
  const auto specs = stability_scenes(700);
  std::size_t expected = 0;
  for (const SceneInfo& scene : SceneRegistry::instance().scenes())
    expected += std::max<std::size_t>(1, scene.settings.size());
  EXPECT_EQ(specs.size(), expected);
  EXPECT_EQ(std::ranges::count(specs, "grazing:n=700,margin=0"), 1);
  for (const auto& spec : specs)
    for (const char* variant : {"aCPU2+CPU2", "aGPU2@host+GPUv2@host"}) {
      const Cell cell = cell_of(spec, variant);
      EXPECT_EQ(cell.outcome, Outcome::exact) << spec << ' ' << variant << ' ' << cell.found.reason;
    }
}

TEST(StabilityRun, SaysWhatItLeavesOutAndWhy) {
  const StabilityLimits narrow{.seconds = 60, .overlaps = 1000, .all_pairs = 100};
  const auto flood = measure_scene("winding:n=500", {"aCPU2+CPU2"}, narrow);
  ASSERT_EQ(flood.size(), 1u);
  EXPECT_EQ(flood[0].outcome, Outcome::unavailable);
  EXPECT_FALSE(flood[0].answered);
  EXPECT_NE(flood[0].found.reason.find("overlapping spheres"), std::string::npos);
  const auto both = measure_scene("rod:n=500", {"CPU1", "aCPU2+CPU2"}, narrow);
  EXPECT_NE(both[0].found.reason.find("O(n^2)"), std::string::npos);
  EXPECT_EQ(both[1].outcome, Outcome::exact);
  EXPECT_EQ(measure_scene("rod:n=100", {"CPU1"}, narrow)[0].outcome, Outcome::exact) << "at the limit";
  EXPECT_NE(measure_scene("rod:n=101", {"CPU1"}, narrow)[0].outcome, Outcome::exact);
  // Of an animation the frame in the middle.
  const Input path = open_input("path1:n=90");
  const auto pairs = [&](std::uint32_t f) { return reference::find(path.animation->frame(f)).pair_count; };
  ASSERT_NE(pairs(0), pairs(path.animation->frames() / 2));
  EXPECT_EQ(measure_scene("path1:n=90", {"CPU1"}, narrow)[0].exact_pairs,
            pairs(path.animation->frames() / 2));
  const auto slow = measure_scene("rod:n=60000", {"aCPU2+CPU2"}, {.seconds = 1e-9});
  EXPECT_NE(slow[0].found.reason.find("likely to take longer"), std::string::npos);
}

TEST(StabilityRun, EstimatesOverlapsFromASample) {
  const Chain chain = open_input("winding:n=5000,contacts=50").animation->frame(0);
  const auto right = static_cast<double>(reference::find(chain).pair_count);
  EXPECT_NEAR(estimated_overlaps(chain), right, 0.1 * right);
  // Of so few each is asked, and none overlaps itself.
  for (const char* spec : {"winding:n=200", "rod:n=50", "coincident:n=256", "path1:n=1"}) {
    const Chain few = open_input(spec).animation->frame(0);
    double overlaps = 0;
    for (std::uint32_t i = 0; i < few.size(); ++i)
      for (std::uint32_t j = i + 1; j < few.size(); ++j)
        overlaps += reference::GapEstimate::of(few[i], few[j]).gap <= 0;
    EXPECT_DOUBLE_EQ(estimated_overlaps(few), overlaps) << spec;
  }
}

/// About ten minutes, on one core.
TEST(StabilityLong, RobustIsExactOnEverySceneOfAMillionSpheres) {
  for (const auto& spec : stability_scenes(1'000'000))
    for (const Cell& cell : measure_scene(spec, {"aCPU2+CPU2", "aCPU2+Dual"})) {
      EXPECT_TRUE(cell.outcome == Outcome::exact || cell.outcome == Outcome::unavailable)
          << spec << ' ' << cell.variant << ' ' << cell.found.reason;
      if (cell.outcome == Outcome::unavailable)
        fmt::print("{} {}: {}\n", spec, cell.variant, cell.found.reason);
    }
}

}  // namespace
}  // namespace catena::bench
