#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <new>
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

/// Has no memory left.
class Starved final : public Variant {
 public:
  void build(const Chain&) override { throw std::bad_alloc(); }
  void find(const Chain&, const Request&, Collisions&) override {}
  Timings timings() const override { return {}; }
};

TEST(Stability, WantOfMemoryIsNoDefect) {
  const Chain chain = open_input("lattice:n=100").animation->frame(0);
  Starved starved;
  VariantInfo info;
  info.name = "Starved", info.arithmetic = "robust";
  const Cell cell = measure("lattice", info, starved, chain, reference::find(chain));
  EXPECT_EQ(cell.outcome, Outcome::undecided);
  EXPECT_FALSE(cell.defect);
  EXPECT_EQ(name_of(cell.outcome), "undecided");
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

/// Answers rightly, by a tree of one node, which is no sphere where it is spoilt.
class OneNode final : public Variant {
 public:
  explicit OneNode(double radius) : radius_(radius) {}
  void build(const Chain& chain) override {
    chain_ = chain;
    whole_->build(chain);
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    whole_->find(chain, request, result);
  }
  void visit_bounds(BoundsVisitor& visitor) const override {
    for (std::uint32_t i = 0; i < chain_.size(); ++i) {
      const Sphere& s = chain_[i];
      visitor.edge(chain_.size(), Sphere64{0, 0, 0, radius_}, i, Sphere64{s.x, s.y, s.z, s.radius});
    }
  }
  Timings timings() const override { return {}; }

 private:
  const double radius_;
  Chain chain_;
  std::unique_ptr<Variant> whole_ = StrategyRegistry::instance().make("CPU1");
};

TEST(Stability, OneNodeThatIsNoNumberIsEnough) {
  const Chain chain = open_input("lattice:n=100").animation->frame(0);
  VariantInfo info;
  info.name = "OneNode", info.arithmetic = "robust";
  OneNode sound(1e6), spoilt(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(measure("lattice", info, sound, chain, reference::find(chain)).outcome, Outcome::exact);
  const Cell cell = measure("lattice", info, spoilt, chain, reference::find(chain));
  EXPECT_EQ(cell.outcome, Outcome::not_finite);
  EXPECT_EQ(cell.not_finite_nodes, 1u);
  EXPECT_TRUE(cell.defect);
}

/// Throws what is no declared limit.
class Throwing final : public Variant {
 public:
  void build(const Chain&) override { throw std::runtime_error("no memory"); }
  void find(const Chain&, const Request&, Collisions&) override {}
  Timings timings() const override { return {}; }
};

TEST(Stability, AVariantThatThrowsIsWrongAndWasNotAsked) {
  const Chain chain = open_input("lattice:n=100").animation->frame(0);
  VariantInfo info;
  info.name = "Throwing", info.arithmetic = "literal", info.exact = false;
  Throwing throwing;
  const Cell cell = measure("lattice", info, throwing, chain, reference::find(chain));
  EXPECT_EQ(cell.outcome, Outcome::wrong);
  EXPECT_TRUE(cell.defect);
  EXPECT_EQ(to_json(cell).count("missing"), 0u) << "nothing was found out about its pairs";
}

Cell cell_like(const char* variant, Outcome outcome, std::uint64_t missing = 0, std::uint64_t invented = 0) {
  Cell cell{"knot", variant, "literal", 9, 5, outcome, {}, {}, {}};
  cell.found.ran = outcome != Outcome::refused && outcome != Outcome::unavailable;
  cell.found.comparison.missing = missing, cell.found.comparison.invented = invented;
  cell.found.comparison.worst_margin = 1e-7;
  return cell;
}

/// The line of the table that these cells make.
std::string table_line(const std::vector<Cell>& cells) {
  testing::internal::CaptureStdout();
  StabilityReport report(StabilityReport::Form::table, {"knot"}, {"A", "B", "C", "D"}, {"literal"});
  report.scene(cells);
  std::string line = testing::internal::GetCapturedStdout();
  line.erase(0, line.find('\n') + 1);  // the heading
  while (!line.empty() && (line.back() == ' ' || line.back() == '\n')) line.pop_back();
  return line;
}

TEST(Stability, ATableShowsTheWorstOfAnArithmeticAndHowManyAreLikeIt) {
  const Cell right = cell_like("A", Outcome::exact), few = cell_like("B", Outcome::wrong, 1, 2),
             more = cell_like("C", Outcome::wrong, 4, 2), refused = cell_like("D", Outcome::refused),
             absent = cell_like("D", Outcome::unavailable);
  const std::string pairs = "knot " + std::string(9, ' ') + "5  ";
  EXPECT_EQ(table_line({right}), pairs + "exact");
  EXPECT_EQ(table_line({right, right}), pairs + "exact");
  for (const auto& cells : {std::vector{right, few, more}, std::vector{more, right, few}})
    EXPECT_EQ(table_line(cells), pairs + "wrong -4 +2 by 1e-07 (2/3)");
  EXPECT_EQ(table_line({few, right, absent}), pairs + "wrong -1 +2 by 1e-07 (1/2)");
  EXPECT_EQ(table_line({right, refused}), pairs + "exact") << "a limit is no outcome beside one";
  EXPECT_EQ(table_line({refused}), pairs + "refused");
  EXPECT_EQ(table_line({absent}), pairs + "-");
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
