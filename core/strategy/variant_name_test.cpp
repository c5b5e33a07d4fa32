#include "catena/core/strategy/variant_name.h"

#include <gtest/gtest.h>

#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

TEST(VariantName, IsTakenApartAndPutTogetherAgain) {
  const auto name = VariantName::parse("aGPU2@host(subtree=6,block=2)+GPU2(threads=64)/literal");
  ASSERT_TRUE(name.composed());
  EXPECT_EQ(name.stages[0], (StageName{"aGPU2@host", {{"subtree", "6"}, {"block", "2"}}}));
  EXPECT_EQ(name.stages[0].algorithm(), "aGPU2");
  EXPECT_TRUE(name.stages[0].is_host_twin());
  EXPECT_FALSE(name.stages[1].is_host_twin());
  EXPECT_EQ(name.arithmetic, "literal");
  EXPECT_EQ(name.plain().text(), "aGPU2@host+GPU2/literal");
  for (const char* text : {"CPU1", "CPU1/double", "aCPU2+CPU2", "GPU1@host(threads=2)",
                           "A(x=a/b+c)+B/literal", "mutant:grid-truncates-toward-zero"})
    EXPECT_EQ(VariantName::parse(text).text(), text);
}

TEST(VariantName, EveryListedNameIsItsParts) {
  for (const VariantInfo& info : StrategyRegistry::instance().variants(true)) {
    EXPECT_EQ(VariantName::parse(info.name), info.parts) << info.name;
    const VariantInfo described = StrategyRegistry::instance().describe(info.name);
    EXPECT_EQ(described.name, info.name);
    EXPECT_EQ(described.arithmetic, info.arithmetic) << info.name;
    EXPECT_EQ(described.exact, info.exact) << info.name;
    EXPECT_EQ(described.all_pairs, info.all_pairs) << info.name;
    EXPECT_EQ(described.has_tree, info.has_tree) << info.name;
    EXPECT_EQ(described.on_device(), info.on_device()) << info.name;
  }
}

// What a name with parameters was taken for while each reader parsed it anew: --n 1000000 compared all pairs.
TEST(VariantName, ParametersChangeNothingElseOfADescription) {
  const VariantInfo info = StrategyRegistry::instance().describe("GPU1@host(threads=2)/literal");
  EXPECT_TRUE(info.all_pairs);
  EXPECT_FALSE(info.exact);
  EXPECT_EQ(info.arithmetic, "literal");
  EXPECT_EQ(info.name, "GPU1@host(threads=2)/literal");
  EXPECT_THROW(StrategyRegistry::instance().describe("GPU1@host(blocks=2)"), InputError);
}

TEST(VariantName, IsRefusedWhereItCannotBeRead) {
  for (const char* text :
       {"A(x=1", "A(x)", "A(=1)", "A)+B", "A(x=1)y", "A/", "A(x=1,)", "A(,x=1)", "A+B(x=1,,y=2)"})
    EXPECT_THROW(VariantName::parse(text), InputError) << text;
}

}  // namespace
}  // namespace catena
