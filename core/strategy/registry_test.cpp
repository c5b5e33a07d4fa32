#include "catena/core/strategy/registry.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <typeinfo>

#include "catena/core/error.h"
#include "catena/core/strategy/test_registry.h"

namespace catena {
namespace {

using test::refusal, test::registry;

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

/// What is said of a variant is what its stages say of themselves.
TEST(Registry, DescribesAVariantByItsStages) {
  std::size_t composed = 0, unavailable = 0, hidden = 0, priced = 0;
  for (const bool all : {false, true})
    for (const VariantInfo& v : registry().variants(all)) {
      EXPECT_TRUE(all || !v.hidden) << v.name;
      hidden += v.hidden, priced += v.cost.has_value();
      ASSERT_EQ(v.parts.stages.size(), v.places.size()) << v.name;
      const StrategyInfo& first = registry().strategy(v.parts.stages.front().strategy);
      const StrategyInfo& last = registry().strategy(v.parts.stages.back().strategy);
      const bool whole = v.parts.stages.size() == 1;
      composed += !whole;
      EXPECT_EQ(v.places.front(), first.place) << v.name;
      EXPECT_EQ(v.places.back(), last.place) << v.name;
      EXPECT_EQ(v.promises.same_bits, first.promises.same_bits) << v.name;
      EXPECT_EQ(v.promises.same_order, last.promises.same_order) << v.name;
      EXPECT_EQ(v.peer, whole && first.peer) << v.name;
      EXPECT_EQ(v.all_pairs, whole && first.all_pairs) << v.name;
      EXPECT_EQ(v.has_tree, !whole || first.has_tree) << v.name;
      EXPECT_EQ(v.cost, whole ? first.cost : std::nullopt) << v.name;
      if (!v.peer && !v.hidden) {
        EXPECT_EQ(v.exact, v.arithmetic == "robust") << v.name;
      }

      std::string why, who;
      for (const StrategyInfo* stage : {&last, &first})
        if (stage->unavailable)
          if (const auto reason = stage->unavailable()) why = *reason, who = stage->name;
      EXPECT_EQ(v.unavailable.value_or(""), why) << v.name;
      if (why.empty()) continue;
      ++unavailable;
      EXPECT_EQ(refusal(v.name).find(who + " is not available here: " + why), 0u) << refusal(v.name);
    }
  EXPECT_GT(composed, 0u);
  EXPECT_GT(hidden, 0u);
  EXPECT_GT(priced, 0u);
  for (const std::string& name : registry().strategy_names())
    EXPECT_NE(name.substr(0, 7), "mutant:") << "is hidden";
}

TEST(Registry, KeepsTheSettingsOfEachStage) {
  for (const char* name : {"aGPU2@host(subtree=8)+GPU2@host(threads=2)", "aCPU2+GPU2@host(threads=3)/double",
                           "Hybrid(threads=2)", "aGPU2@host(subtree=8,block=2)+CPU2/literal"})
    EXPECT_EQ(registry().describe(name).name, name);
  EXPECT_EQ(registry().on_host(VariantName::parse("aGPU2(subtree=8)+GPU2/double")).text(),
            "aGPU2@host(subtree=8)+GPU2@host/double");
  EXPECT_EQ(registry().on_host(VariantName::parse("aCPU2+GPU2")).text(), "aCPU2+GPU2@host");
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
  EXPECT_NE(refusal("aCPU2(threads=2)+CPU2").find("takes no parameters"), std::string::npos);
}

/// A name alone, which is not taken apart, means what it means with an arithmetic and parameters written.
TEST(Registry, ANameAloneMeansItsUsualArithmeticAndDefaults) {
  StrategyRegistry some;
  std::vector<std::string> made;
  const auto by = [&](const std::string& arithmetic) {
    return [&made, arithmetic](const Parameters& parameters) {
      made.push_back(arithmetic + " " + parameters.choice("x", {"one", "two"}) +
                     (parameters.given("x") ? " given" : ""));
      return registry().make("CPU1");
    };
  };
  const std::vector<ParameterInfo> parameters{{"x", "one", "number"}};
  const StrategyInfo a{.name = "A", .summary = "usual too", .parameters = parameters},
      b{.name = "B", .summary = "one unusual", .parameters = parameters},
      c{.name = "C", .summary = "two unusual", .parameters = parameters};
  some.add_variant(a, {"literal"}, by("literal"));
  some.add_variant(a, {"robust"}, by("robust"));
  some.add_variant(b, {"literal"}, by("literal"));
  some.add_variant(c, {"literal"}, by("literal"));
  some.add_variant(c, {"double"}, by("double"));
  for (const char* name : {"A", "A(x=two)", "A/literal", "B", "B()", "C/double", "C(x=two)/literal"})
    some.make(name), some.make_held(name);
  EXPECT_EQ(made, (std::vector<std::string>{"robust one", "robust one", "robust two given",
                                            "robust two given", "literal one", "literal one", "literal one",
                                            "literal one", "literal one", "literal one", "double one",
                                            "double one", "literal two given", "literal two given"}));
  for (const char* none : {"C", "A/double", "D"}) {
    EXPECT_THROW(some.make(none), InputError) << none;
    EXPECT_THROW(some.make_held(none), InputError) << none;
  }
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

/// Which of two a search is made by, nobody could tell: the first for a name alone, the last for a stage.
TEST(Registry, RefusesASecondOfOneNameAndArithmetic) {
  StrategyRegistry some;
  const ArithmeticInfo robust{"robust"}, literal{"literal"};
  const StrategyInfo a{.name = "A", .summary = "one"}, b{.name = "B", .summary = "two stages"};
  const StrategyRegistry::TreeType tree{typeid(int), true, nullptr};
  some.add_variant(a, robust, nullptr);
  some.add_variant(a, literal, nullptr);
  some.add_construction(b, robust, tree, nullptr);
  some.add_traversal(b, robust, tree, nullptr);
  EXPECT_THROW(some.add_variant(a, robust, nullptr), std::logic_error);
  EXPECT_THROW(some.add_variant(a, literal, nullptr, true), std::logic_error);
  EXPECT_THROW(some.add_construction(b, robust, tree, nullptr), std::logic_error);
  EXPECT_THROW(some.add_traversal(b, robust, tree, nullptr), std::logic_error);
  EXPECT_EQ(some.strategy_names(), (std::vector<std::string>{"A", "B"}));
}

}  // namespace
}  // namespace catena
