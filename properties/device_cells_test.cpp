#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/testing/no_device.h"

namespace catena::properties {
namespace {

/// So many spheres that a device's cells are sorted by bins which are begun some thousands at a time, and
/// which are more than those of fewer spheres may be.
TEST(DeviceCells, OfMoreBinsThanAreBegunAtATime) {
  if (const auto why = no_device()) GTEST_SKIP() << *why;
  constexpr std::uint32_t side = 290;  // 18 million cells
  std::vector<Sphere> spheres;
  std::vector<std::uint32_t>
      expected;  // those above and below, in front and behind; beside it are neighbours
  const auto beside = [](std::uint32_t k) { return std::uint32_t{k > 0} + (k + 1 < side); };
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        spheres.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0.55f});
        expected.push_back(beside(y) + beside(z));
      }
  const Chain chain(std::move(spheres));
  Collisions found;
  for (const char* name : {"DeviceGrid", "DeviceHybrid(crowd=0)"}) {
    const auto variant = StrategyRegistry::instance().make(name);
    variant->build(chain);
    variant->find(chain, {.want = Request::Want::counts}, found);
    EXPECT_EQ(found.pair_count, std::uint64_t{2} * side * side * (side - 1)) << name;
    EXPECT_TRUE(found.count == expected) << name;
  }
}

}  // namespace
}  // namespace catena::properties
