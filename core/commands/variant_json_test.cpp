#include "catena/core/commands/variant_json.h"

#include <gtest/gtest.h>

#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

nlohmann::ordered_json described(const char* name) {
  return to_json(StrategyRegistry::instance().describe(name));
}

TEST(VariantJson, SaysTheStagesAndTheirSettings) {
  const auto json = described("aGPU2@host(subtree=256)+CPU2/literal");
  ASSERT_EQ(json["stages"].size(), 2u);
  const auto& built = json["stages"][0];
  EXPECT_EQ(built["text"], "aGPU2@host(subtree=256)");
  EXPECT_EQ(built["strategy"], "aGPU2@host");
  EXPECT_EQ(built["algorithm"], "aGPU2");
  EXPECT_EQ(built["on_host"], true);
  EXPECT_EQ(built["settings"], (nlohmann::ordered_json{{"subtree", "256"}}));
  EXPECT_EQ(built["place"], "host");
  EXPECT_EQ(json["stages"][1]["on_host"], false);
  EXPECT_EQ(json["stages"][1]["settings"], nlohmann::ordered_json::object());
  EXPECT_EQ(json["arithmetic"], "literal");
  EXPECT_EQ(json["exact"], false);
  EXPECT_EQ(json["has_tree"], true);
  EXPECT_FALSE(json.contains("hidden"));
}

TEST(VariantJson, OfEveryVariantAsItIsDescribed) {
  for (const auto& v : StrategyRegistry::instance().variants(true)) {
    const auto json = to_json(v);
    EXPECT_EQ(json["stages"].size(), v.parts.stages.size()) << v.name;
    EXPECT_EQ(json["arithmetic"], v.arithmetic) << v.name;
    EXPECT_EQ(json["exact"], v.exact) << v.name;
    EXPECT_EQ(json["has_tree"], v.has_tree) << v.name;
    EXPECT_EQ(json["all_pairs"], v.all_pairs) << v.name;
    EXPECT_EQ(json["peer"], v.peer) << v.name;
    EXPECT_EQ(json["on_device"], v.on_device()) << v.name;
    EXPECT_EQ(json.contains("hidden"), v.hidden) << v.name;
  }
}

}  // namespace
}  // namespace catena
