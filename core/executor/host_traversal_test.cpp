#include "catena/core/executor/host_traversal.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

const Decision& decided(const Plan& plan, const std::string& step) {
  for (const Decision& decision : plan)
    if (decision.step == step) return decision;
  throw std::out_of_range(step);
}

/// What was left out was left out of the search that was asked for, not of one for all spheres.
TEST(HostTraversal, TellsThePlanOfItsLastSearch) {
  const auto variant = StrategyRegistry::instance().make("aCPU2+GPU2@host(threads=7)");
  const auto plan_of = [&](float radius, const SphereRange& queries) {
    const Chain chain(std::vector<Sphere>(50, Sphere{0, 0, 0, radius}));
    Collisions found;
    variant->build(chain);
    variant->find(chain, {.queries = queries}, found);
    return variant->plan();
  };
  const auto threads = [](const Plan& plan) { return decided(plan, "more threads").reason; };
  EXPECT_EQ(threads(plan_of(1, {})), "7 of 7 for 50 spheres");
  EXPECT_TRUE(threads(plan_of(1, {10, 13})).starts_with("3 of 7 for 3 spheres: "));
  EXPECT_TRUE(threads(plan_of(1, {48, 1000})).starts_with("2 of 7 for 2 spheres: "));
  EXPECT_TRUE(decided(plan_of(1, {}), "range checks").left_out);
  EXPECT_FALSE(decided(plan_of(1e-20f, {}), "range checks").left_out);
  EXPECT_TRUE(decided(plan_of(1, {}), "range checks").left_out);
}

}  // namespace
}  // namespace catena
