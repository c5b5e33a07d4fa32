#include "catena/core/flushed_floats.h"

#include <gtest/gtest.h>

#include <limits>

#include "catena/core/default_floats.h"

namespace catena {
namespace {

/// Volatile, or the compiler would compute it in its own environment.
float half_of_the_least_normal() {
  volatile float least = std::numeric_limits<float>::min();
  return least * 0.5f;
}

TEST(FlushedFloats, HaveNoSubnormalNumbersWhileTheyLive) {
#ifndef __SSE__
  GTEST_SKIP() << "only of x86 is it told how";
#endif
  {
    const FlushedFloats outer;
    EXPECT_EQ(half_of_the_least_normal(), 0);
    volatile float subnormal = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(subnormal * 0x1p100f, 0) << "nor are they read";
    { const FlushedFloats inner; }
    EXPECT_EQ(half_of_the_least_normal(), 0) << "the caller's come back";
  }
  EXPECT_GT(half_of_the_least_normal(), 0);
  EXPECT_TRUE(DefaultFloats::stands());
}

}  // namespace
}  // namespace catena
