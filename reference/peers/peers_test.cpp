#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/all_pairs.h"
#include "catena/reference/compare.h"
#include "catena/reference/reference.h"
#include "catena/reference/testing/nasty.h"

namespace catena::reference {
namespace {

VariantInfo fcl() { return StrategyRegistry::instance().describe("FCL"); }

Collisions fcl_collisions(const Chain& chain, const Request& request = {}) {
  const auto variant = StrategyRegistry::instance().make("FCL");
  Collisions found;
  variant->build(chain);
  variant->find(chain, request, found);
  return found;
}

class Fcl : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = fcl().unavailable) GTEST_SKIP() << *why;
  }
};

TEST(FclVariant, IsListedAsAPeerThatRounds) {
  EXPECT_TRUE(fcl().peer);
  EXPECT_FALSE(fcl().exact);
  EXPECT_EQ(fcl().name, "FCL");
  EXPECT_EQ(fcl().arithmetic, "binary64");
  const auto variants = StrategyRegistry::instance().variants();
  EXPECT_EQ(std::ranges::count(variants, "FCL", &VariantInfo::name), 1);
}

RC_GTEST_FIXTURE_PROP(Fcl, AgreesWhereNoPairIsNearTouching, ()) {
  const auto at =
      rc::gen::map(rc::gen::inRange(-1000, 1000), [](int k) { return static_cast<float>(k) / 64; });
  const auto sphere =
      rc::gen::construct<Sphere>(at, at, at, rc::gen::map(at, [](float r) { return std::fabs(r / 8); }));
  const Chain chain(*rc::gen::container<std::vector<Sphere>>(sphere));
  const AllPairs exact = all_pairs(chain);
  RC_PRE(exact.tightest.margin > 0x1p-40);
  RC_TAG(exact.answer.pair_count > 0 ? "pairs" : "no pairs");
  RC_ASSERT(compare(chain, exact.answer, fcl_collisions(chain)).right());
}

RC_GTEST_FIXTURE_PROP(Fcl, DigestsEveryValidChainAndErrsOnlyNearTies, ()) {
  const Chain chain(*testing::nasty_spheres());
  const Comparison c = compare(chain, find(chain), fcl_collisions(chain));
  RC_ASSERT(c.well_formed());
  RC_ASSERT(c.inconsistent_counts == 0u);
  RC_ASSERT(c.worst_margin <= 0x1p-50);
}

TEST_F(Fcl, NoSpheresOneSphereAndAFlood) {
  EXPECT_EQ(fcl_collisions(Chain()).pair_count, 0u);
  EXPECT_EQ(fcl_collisions(Chain({{0, 0, 0, 1}})).count.size(), 1u);
  const Chain flood(std::vector<Sphere>(300, Sphere{1, 2, 3, 0}));
  EXPECT_EQ(fcl_collisions(flood).pair_count, 300u * 299 / 2 - 299);
  EXPECT_THROW(fcl_collisions(flood, {Request::Want::pairs, 5}), PairLimitExceeded);
}

TEST(FclAbsent, SaysWhy) {
  if (!fcl().unavailable) GTEST_SKIP() << "FCL is built in";
  EXPECT_THROW(fcl_collisions(Chain()), CapacityError);
}

}  // namespace
}  // namespace catena::reference
