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

}  // namespace
}  // namespace catena::ranks
