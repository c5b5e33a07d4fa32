#include "catena/bench/regret/regret.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

const StrategyRegistry& registry() { return StrategyRegistry::instance(); }
RegretEffort little() { return {.seconds = 0.02, .rounds = 5, .least_ms = 0.02}; }

TEST(Regret, HoldsAutoAgainstTheQuickestOfTheOthers) {
  const std::vector<VariantInfo> two{registry().describe("CPU1"), registry().describe("Hybrid")};
  const Regret few = regret({"path1:n=8"}, two, little()), many = regret({"yarn:n=3000"}, two, little());
  EXPECT_TRUE(few.best == "CPU1" || few.best == "Hybrid") << few.best;
  EXPECT_EQ(many.best, "Hybrid") << "a thirtieth of the other's time";
  for (const Regret& r : {few, many}) {
    EXPECT_TRUE(r.left_out.empty());
    EXPECT_FALSE(r.chosen.empty());
    EXPECT_EQ(r.auto_ms.size(), r.best_ms.size());
    EXPECT_GE(r.auto_ms.size(), 3u);
    EXPECT_GT(r.ratio(), 0);
  }
  EXPECT_EQ(few.n, 8u);
  EXPECT_EQ(many.input, "yarn/n:3000");
}

TEST(Regret, SaysWhyAnInputIsLeftOut) {
  const std::vector<VariantInfo> one{registry().describe("Hybrid")};
  EXPECT_NE(regret({"winding:n=300000"}, one, little()).left_out.find("overlap"), std::string::npos);
  EXPECT_FALSE(regret({"yarn:n=30"}, {}, little()).left_out.empty());
}

TEST(Regret, IsOfWhatAUserOfThisHostMightTakeInstead) {
  const auto others = regret_variants(registry().variants());
  const auto among = [&](const char* name) {
    return std::ranges::find(others, name, &VariantInfo::name) != others.end();
  };
  for (const char* name : {"Hybrid", "Grid", "ChainTree", "CPU1", "aCPU2+Dual"})
    EXPECT_TRUE(among(name)) << name;
  for (const char* name : {"auto", "CPU1/literal", "aGPU2@host+GPU2@host"}) EXPECT_FALSE(among(name)) << name;
}

TEST(Regret, EverySceneCanBeOpened) {
  const auto scenes = all_scenes(64);
  EXPECT_GE(scenes.size(), 25u);
  for (const WorkloadSpec& scene : scenes) EXPECT_EQ(open_input(scene.input).animation->frame(0).size(), 64u);
}

}  // namespace
}  // namespace catena::bench
