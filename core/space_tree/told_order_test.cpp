#include "catena/core/space_tree/told_order.h"

#include <gtest/gtest.h>

namespace catena {
namespace {

TEST(ToldOrder, IsLeftOutWhereAnEarlierFrameSorted) {
  EXPECT_FALSE(told_order(500, 0).left_out);
  for (const std::uint32_t frames : {1u, 7u}) {
    const Decision told = told_order(500, frames);
    EXPECT_TRUE(told.left_out) << frames;
    EXPECT_NE(told.reason.find(std::to_string(frames) + " frames ago"), std::string::npos) << told.reason;
    EXPECT_NE(told.reason.find("500 lie in"), std::string::npos) << told.reason;
  }
}

}  // namespace
}  // namespace catena
