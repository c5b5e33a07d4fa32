#include "catena/bench/timing/spread.h"

#include <gtest/gtest.h>

namespace catena::bench {
namespace {

TEST(Spread, IsMinimumAndQuartiles) {
  const Spread s = Spread::of({5, 1, 3, 2, 4});
  EXPECT_EQ(s.least, 1);
  EXPECT_EQ(s.lower, 2);
  EXPECT_EQ(s.median, 3);
  EXPECT_EQ(s.upper, 4);
  EXPECT_EQ(Spread::of({7}).upper, 7);
  EXPECT_EQ(Spread::of({1, 2}).median, 1.5);
}

}  // namespace
}  // namespace catena::bench
