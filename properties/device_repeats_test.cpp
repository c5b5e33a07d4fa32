#include <gtest/gtest.h>

#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/testing/no_device.h"

// What depends on the order in which threads come loses a pair once in many runs, if ever.
namespace catena::properties {
namespace {

TEST(DeviceRepeats, OfTenMillionSpheresAreAThousandTimesTheSame) {
  if (const auto why = no_device()) GTEST_SKIP() << *why;
  const Chain chain = open_input("yarn:n=10000000").animation->frame(0);
  const Request only_counts{.want = Request::Want::counts};
  const auto host = StrategyRegistry::instance().make("Hybrid(threads=0)"),
             device = StrategyRegistry::instance().make("DeviceHybrid");
  Collisions right, found;
  host->build(chain), host->find(chain, only_counts, right);
  ASSERT_GT(right.pair_count, 40'000'000u);
  for (int round = 0; round < 1000; ++round) {
    device->build(chain), device->find(chain, only_counts, found);
    ASSERT_EQ(found.pair_count, right.pair_count) << "round " << round;
    ASSERT_TRUE(found.count == right.count) << "round " << round;
  }
}

}  // namespace
}  // namespace catena::properties
