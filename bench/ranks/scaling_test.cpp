// What ranks would have to ask one another for, counted.
#include "catena/bench/ranks/scaling.h"

#include <gtest/gtest.h>

#include "catena/core/ranks/test_chain.h"

namespace catena::ranks {
namespace {

TEST(Scaling, AsksForLittleMoreThanTrulyTouches) {
  for (const char* input : {"yarn:n=60000", "lattice:n=40000", "path2:n=60000"}) {
    const Scaling scaling = measure_scaling(chain_of(input), {.ranks = doubled_ranks(32)});
    ASSERT_EQ(scaling.points.size(), 5u);
    for (const ScalingPoint& p : scaling.points) {
      EXPECT_LE(p.blocks_asked, 2 * p.blocks_touching) << input << " on " << p.ranks;
      EXPECT_LE(p.blocks_touching, p.blocks_asked);
      EXPECT_LE(p.most_spheres, 2 * 60000 / p.ranks + 8) << input << " on " << p.ranks;
    }
  }
  const Chain yarn = chain_of("yarn:n=60000");
  EXPECT_LT(
      measure_scaling(yarn, {.ranks = doubled_ranks(8), .order = Order::space}).points[2].blocks_asked,
      measure_scaling(yarn, {.ranks = doubled_ranks(8), .order = Order::chain}).points[2].blocks_asked / 2);
}

/// Of all ranks together, though the one that asks the most may go by another law, as may points in chain
/// order.
TEST(Scaling, TellsByWhatPowerBlocksAreAskedFor) {
  Scaling made;
  std::uint64_t asked = 1024;
  for (unsigned ranks = 2; ranks <= 16; ranks *= 2, asked /= 4) {  // of blocks an eighth each time
    const std::uint64_t own = asked == 1024 ? 32768 : asked == 256 ? 4096 : asked == 64 ? 512 : 64;
    made.points.push_back({.ranks = ranks,
                           .in_space = true,
                           .blocks = own * ranks,
                           .blocks_asked = asked * ranks,
                           .most_blocks_asked = own / 4});
    made.points.push_back({.ranks = ranks, .blocks = own * ranks, .blocks_asked = own * ranks});
  }
  ASSERT_TRUE(made.surface());
  EXPECT_NEAR(made.surface()->exponent, 2.0 / 3, 1e-9);
  made.points.erase(made.points.begin());
  EXPECT_FALSE(made.surface()) << "three points";
}

}  // namespace
}  // namespace catena::ranks
