#include "catena/core/rounded_up.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace catena {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

RC_GTEST_PROP(RoundedUp, IsTheLeastThatIsNotBelow, ()) {
  const double value = std::ldexp(*rc::gen::inRange(-(1 << 30), 1 << 30) * 1.0, *rc::gen::inRange(-190, 90));
  const float up = rounded_up(value);
  RC_ASSERT(double{up} >= value);
  RC_ASSERT(double{std::nextafter(up, -infinite)} < value);
}

TEST(RoundedUp, KeepsWhatBinary32HoldsAndItsEnds) {
  for (const float value : {0.0f, 1.0f, -0.1f, 0x1p-149f, std::numeric_limits<float>::max()})
    EXPECT_EQ(rounded_up(value), value);
  EXPECT_EQ(rounded_up(0.1), 0.1f);  // above a tenth as it is
  EXPECT_GT(rounded_up(1e-300), 0);
  EXPECT_EQ(rounded_up(1e39), infinite);
  EXPECT_EQ(rounded_up(std::nextafter(1.0, 2.0)), std::nextafter(1.0f, 2.0f));
}

}  // namespace
}  // namespace catena
