#include "catena/bench/examine/examine.h"

#include <gtest/gtest.h>

#include "catena/core/input/input.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

Examination examined(const std::string& arithmetic, const std::string& scene) {
  const Chain chain = open_input(scene).animation->frame(0);
  return examine(arithmetic, chain, reference::find(chain));
}

TEST(Examine, CountsEveryParentOnItsLevel) {
  const Examination e = examined("literal", "rod:n=1000");
  ASSERT_EQ(e.levels.size(), 10u);
  EXPECT_EQ(e.all.parents, 999u);
  EXPECT_EQ(e.levels[0].parents, 500u);
  EXPECT_EQ(e.levels[9].parents, 1u);
  EXPECT_GT(e.all.failing, 900u) << "nearly all: a rounded centre leaves one child or the other out";
  EXPECT_GT(e.all.worst_shortfall, 0);
  EXPECT_LT(e.all.worst_shortfall, 1e-4);
  EXPECT_EQ(e.missing + e.invented, 0u);
}

TEST(Examine, TellsPairsLostByTheTreeFromThoseDecidedWrongly) {
  const Examination nan = examined("literal", "coincident:n=300");
  EXPECT_GT(nan.missing, 1000u);
  EXPECT_EQ(nan.lost_by_tree, nan.missing)
      << "equal spheres touch in any arithmetic; only the tree loses them";
  const Examination near = examined("literal", "grazing:n=2000,margin=0,radius=0.7");
  EXPECT_GT(near.missing, near.lost_by_tree) << "near ties are also decided wrongly";
  EXPECT_GT(near.invented, 100u);
  EXPECT_LT(examined("double", "far:n=1000,exponent=20").all.worst_shortfall, 1e-9);
}

}  // namespace
}  // namespace catena::bench
