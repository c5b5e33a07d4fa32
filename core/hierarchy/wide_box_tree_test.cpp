#include "catena/core/hierarchy/wide_box_tree.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace catena {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::vector<std::uint32_t> met(const WideBoxTree& tree, const Box& box) {
  std::vector<std::uint32_t> all;
  tree.for_each_meeting(box, [&](std::uint32_t k) { all.push_back(k); });
  return all;
}

Box cube(float at) { return {{at, 0, 0}, {at + 1, 1, 1}}; }

TEST(WideBoxTree, FindsTheBoxesThatMeet) {
  for (const std::uint32_t boxes : {0u, 1u, 16u, 17u, 257u, 5000u}) {
    WideBoxTree tree;
    tree.clear(boxes);
    for (std::uint32_t k = 0; k < boxes; ++k) tree.set(k, cube(2 * static_cast<float>(k)));
    tree.refresh(0, boxes);
    std::vector<std::uint32_t> near;
    for (const std::uint32_t k : {4u, 5u, 6u})
      if (k < boxes) near.push_back(k);
    EXPECT_EQ(met(tree, {{8, 0, 0}, {13, 0, 0}}), near) << boxes;
    EXPECT_TRUE(met(tree, {{-2, 0, 0}, {-1, 0, 0}}).empty());
    EXPECT_EQ(met(tree, {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}).size(), boxes);
  }
}

/// A sphere as large as floats are has a box without end, which meets whatever is there: not what is not.
TEST(WideBoxTree, HasNothingWhereNoBoxWasSet) {
  WideBoxTree tree;
  tree.clear(40);
  tree.set(20, cube(0));
  tree.refresh(20, 21);
  EXPECT_EQ(met(tree, {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}),
            std::vector<std::uint32_t>{20});
}

}  // namespace
}  // namespace catena
