#include "catena/core/strategy/registry.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "catena/core/error.h"

namespace catena {
namespace {

const StrategyRegistry& registry() { return StrategyRegistry::instance(); }

std::string refusal(const std::string& name) {
  try {
    registry().make(name);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Registry, EveryStrategyFileIsRegistered) {
  // A strategy file that the build dropped would be tested by nothing.
  const auto names = registry().strategy_names();
  const std::set<std::string> registered(names.begin(), names.end());
  for (const auto& entry : std::filesystem::directory_iterator(CATENA_SOURCE_DIR "/variants")) {
    if (entry.path().extension() != ".cpp" || entry.path().stem().string().ends_with("_test")) continue;
    const std::string stem = entry.path().stem().string();
    EXPECT_TRUE(registered.contains(stem) || registered.contains(stem + "@host")) << entry.path();
  }
}

TEST(Registry, EveryListedVariantIsMadeByItsName) {
  const auto variants = registry().variants();
  EXPECT_GE(variants.size(), 33u);
  std::set<std::string> names;
  for (const auto& v : variants) {
    EXPECT_TRUE(names.insert(v.name).second) << v.name << " is listed twice";
    if (!v.unavailable) {
      const auto variant = registry().make(v.name);
      ASSERT_NE(variant, nullptr) << v.name;
      EXPECT_EQ(variant->resident() != nullptr, v.resident) << v.name;
    }
  }
  for (const char* name : {"CPU1", "aCPU2+CPU2", "aCPU2+CPU2/literal", "aGPU2@host+GPUv2@host/double"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Registry, UnknownNamesSayWhatThereIs) {
  EXPECT_NE(refusal("CPU3").find(" CPU1, CPU2, "), std::string::npos) << refusal("CPU3");
  EXPECT_NE(refusal("aCPU2").find("one stage only"), std::string::npos) << refusal("aCPU2");
  EXPECT_NE(refusal("aCPU3+CPU2").find("no construction 'aCPU3'"), std::string::npos);
  EXPECT_NE(refusal("aCPU2+CPU3").find("no traversal 'CPU3'"), std::string::npos);
  EXPECT_NE(refusal("aCPU2+CPU2/exact").find("no arithmetic 'exact'"), std::string::npos);
  EXPECT_NE(refusal("CPU1/exact").find("has no exact arithmetic"), std::string::npos);
  EXPECT_NE(refusal("").find("no strategy ''"), std::string::npos);
}

TEST(Registry, ParametersAreCheckedAndUsed) {
  EXPECT_NE(registry().make("aGPU2@host(subtree=8,block=2)+GPU2@host(threads=3)"), nullptr);
  EXPECT_NE(refusal("aGPU2@host(subtree=1)+CPU2").find("from 2 to"), std::string::npos);
  EXPECT_NE(refusal("aGPU2@host(leaves=8)+CPU2").find("has no parameter 'leaves'"), std::string::npos);
  EXPECT_NE(refusal("aGPU2@host(subtree=8,subtree=8)+CPU2").find("given twice"), std::string::npos);
  EXPECT_NE(refusal("aGPU2@host(subtree)+CPU2").find("not key=value"), std::string::npos);
  EXPECT_NE(refusal("aGPU2@host(subtree=8+CPU2").find("name(key=value"), std::string::npos);
  EXPECT_NE(refusal("CPU1(threads=2)").find("takes no parameters"), std::string::npos);
}

TEST(Registry, DeclaredLimitIsAClearError) {
  std::vector<Sphere> spheres(1537, Sphere{0, 0, 0, 1});
  const auto variant = registry().make("bGPU2@host+CPU2");
  try {
    variant->build(Chain(spheres));
    FAIL();
  } catch (const CapacityError& error) {
    EXPECT_NE(std::string(error.what()).find("at most 1536"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("aGPU2"), std::string::npos) << error.what();
  }
}

TEST(Registry, FindBeforeBuildIsAProgrammingError) {
  const Chain chain(std::vector<Sphere>(3, Sphere{0, 0, 0, 1}));
  Collisions result;
  EXPECT_THROW(registry().make("aCPU2+CPU2")->find(chain, {}, result), std::logic_error);
}

}  // namespace
}  // namespace catena
