#include "catena/properties/suite.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include "catena/core/error.h"
#include "catena/core/strategy/test_variant.h"

namespace catena::properties {
namespace {

/// All pairs, and on chains of exactly 7 spheres whatever a test asks for. Hidden, so that no other test
/// meets it.
class Moody final : public Variant {
 public:
  enum class Mood { right, throws, refuses };
  static inline Mood mood = Mood::right;

  void build(const Chain& chain) override {
    if (chain.size() != 7 || mood == Mood::right) return;
    if (mood == Mood::refuses) throw CapacityError("at most 6 spheres, or 8");
    throw std::runtime_error("out of sorts");
  }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    all_pairs_->build(chain);
    all_pairs_->find(chain, request, result);
  }
  Timings timings() const override { return {}; }

 private:
  std::unique_ptr<Variant> all_pairs_ = StrategyRegistry::instance().make("CPU1");
};

const test::RegisterHidden<Moody> moody{{.name = "Moody", .summary = "as a test asks"}};

Case row(std::uint32_t n) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i)
    spheres.push_back({1.5f * static_cast<float>(i % 20), static_cast<float>(i / 20), 0, 1});
  return Case::of(Chain(std::move(spheres)));
}

/// The properties that a suite asks about while `ask` runs.
template <class Ask>
std::multiset<std::string> asked(Suite& suite, const Ask& ask) {
  std::multiset<std::string> names;
  suite.watch([&](const Subject&, const Property& property) { names.insert(property.name()); });
  ask();
  suite.watch({});
  return names;
}

TEST(Suite, AsksForEveryPropertyInTurn) {
  for (const char* variant : {"aCPU2+CPU2", "Grid"}) {
    Suite suite({Subject::named(variant)});
    const Case test = row(30);
    const auto all = asked(suite, [&] { EXPECT_FALSE(suite.check(test)); });
    const auto always = asked(suite, [&] { EXPECT_FALSE(suite.check_always(test)); });
    EXPECT_GT(all.size(), always.size());
    EXPECT_FALSE(always.empty());
    const std::size_t turns = 40;
    const auto some = asked(suite, [&] {
      for (std::uint64_t turn = 0; turn < turns; ++turn) EXPECT_FALSE(suite.check_some(test, turn));
    });
    for (const std::string& name : all) EXPECT_GE(some.count(name), always.count(name) ? turns : 1u) << name;
    EXPECT_EQ(std::set<std::string>(some.begin(), some.end()), std::set<std::string>(all.begin(), all.end()));
    EXPECT_EQ(asked(suite, [&] { EXPECT_TRUE(suite.check_all(test).empty()); }), all);
  }
}

TEST(Suite, AsksOfARoundedVariantOneTimeInFour) {
  Suite suite({Subject::named("aCPU2+CPU2/double")});
  const Case test = row(30);
  for (std::uint64_t turn = 0; turn < 12; ++turn)
    EXPECT_EQ(asked(suite, [&] { suite.check_some(test, turn); }).empty(), turn % 4 != 0) << turn;
  EXPECT_TRUE(asked(suite, [&] { suite.check_always(test); }).empty());
}

TEST(Suite, LeavesAllPairsOutOnLongChainsAlone) {
  Suite suite({Subject::named("CPU1")});
  EXPECT_FALSE(asked(suite, [&] { suite.check_always(row(600)); }).empty());
  EXPECT_TRUE(asked(suite, [&] { suite.check_always(row(601)); }).empty());
}

TEST(Suite, AThrowIsAFindingAndARefusalIsCounted) {
  const Case test = row(7), other = row(8);
  Suite suite({Subject::named("Moody")});
  EXPECT_FALSE(suite.check(test));
  EXPECT_EQ(suite.tally().refusals, 0u);

  Moody::mood = Moody::Mood::throws;
  const auto finding = suite.check(test);
  ASSERT_TRUE(finding);
  EXPECT_EQ(finding->variant, "Moody");
  EXPECT_EQ(finding->what, "threw: out of sorts");
  EXPECT_TRUE(suite.repeats(*finding, test.chain));
  EXPECT_FALSE(suite.repeats(*finding, other.chain));
  EXPECT_FALSE(suite.repeats({finding->variant, "no such property", ""}, test.chain));
  EXPECT_FALSE(suite.repeats({"Another", finding->property, ""}, test.chain));

  Moody::mood = Moody::Mood::refuses;
  EXPECT_FALSE(suite.repeats(*finding, test.chain));
  EXPECT_FALSE(suite.check(test));
  EXPECT_GT(suite.tally().refusals, 0u);
  Moody::mood = Moody::Mood::right;
}

}  // namespace
}  // namespace catena::properties
