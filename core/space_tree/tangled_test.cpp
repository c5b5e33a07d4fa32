#include "catena/core/space_tree/tangled.h"

#include <gtest/gtest.h>

#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/properties/generators/dice.h"

namespace catena {
namespace {

/// Stretches of 128 spheres, each about a place: along a line, or anywhere in a cube of so many of their
/// widths.
Chain stretches(std::uint32_t count, bool along_a_line, float widths) {
  properties::Dice dice(3);
  std::vector<Sphere> spheres;
  for (std::uint32_t s = 0; s < count; ++s) {
    const auto at = [&] { return widths / 2 * dice.symmetric(); };
    const float x = along_a_line ? static_cast<float>(s) : at(), y = along_a_line ? 0 : at(),
                z = along_a_line ? 0 : at();
    for (int k = 0; k < 128; ++k) {
      const auto beside = [&] { return 0.5f * dice.symmetric(); };
      const float dx = beside(), dy = beside(), dz = beside();
      spheres.push_back({x + dx, y + dy, z + dz, 0.01f});
    }
  }
  return Chain(std::move(spheres));
}

TEST(Tangled, AreStretchesThatMeetManyOthers) {
  for (const std::uint32_t count : {20u, 200u, 5000u}) {
    EXPECT_FALSE(tangled(stretches(count, true, 0).view())) << count;
    EXPECT_TRUE(tangled(stretches(count, false, 1).view())) << count << " all in one place";
    EXPECT_FALSE(tangled(stretches(count, false, 1000).view())) << count << " far apart";
  }
  EXPECT_FALSE(tangled(Chain(std::vector<Sphere>(127, Sphere{0, 0, 0, 1})).view()));
}

}  // namespace
}  // namespace catena
