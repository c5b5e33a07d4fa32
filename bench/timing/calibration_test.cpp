#include "catena/bench/timing/calibration.h"

#include <gtest/gtest.h>

namespace catena::bench {
namespace {

/// Long enough for any clock, short enough to stand beside every sample.
TEST(Calibration, TakesAFractionOfAMillisecond) {
  double one = 1e9, all = 1e9;
  for (int k = 0; k < 50; ++k) {
    const Load load = measured_load();
    one = std::min(one, load.one_ms);
    all = std::min(all, load.all_ms);
  }
  EXPECT_GT(one, 0.01);
  EXPECT_LT(one, 20) << "at its best, also by a sanitizer";
  EXPECT_GE(all, one / 2) << "every thread does all of the work";
}

}  // namespace
}  // namespace catena::bench
