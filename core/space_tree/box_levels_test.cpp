#include "catena/core/space_tree/box_levels.h"

#include <gtest/gtest.h>

namespace catena {
namespace {

TEST(BoxLevels, KeepTheMemoryOfLevelsThatComeBack) {
  BoxLevels levels;
  EXPECT_TRUE(levels.empty());
  levels.resize(2);
  levels[1].resize(96);
  const float* const boxes = levels[1].data();
  levels.resize(1);
  EXPECT_EQ(levels.size(), 1u);
  levels.resize(2);
  levels[1].resize(96);
  EXPECT_EQ(levels[1].data(), boxes);
}

}  // namespace
}  // namespace catena
