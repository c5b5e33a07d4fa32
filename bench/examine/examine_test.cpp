#include "catena/bench/examine/examine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/enclosure.h"
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

/// By every edge that the tree shows, whichever child comes last.
TEST(Examine, NamesTheWorstShortfallOfAnyChild) {
  class Worst final : public SphereBoundsVisitor {
   public:
    void sphere(std::uint32_t id, const Sphere64& parent, std::uint32_t, const Sphere64& child) override {
      if (reference::encloses(parent, child)) return;
      most = std::max(most, reference::shortfall(parent, child));
      failing.insert(id);
    }
    double most = 0;
    std::set<std::uint32_t> failing;
  };
  for (const char* scene : {"rod:n=1000", "far:n=300,exponent=20", "yarn:n=500", "mixed_radii:n=400"}) {
    const Chain chain = open_input(scene).animation->frame(0);
    const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2/literal");
    variant->build(chain);
    Worst worst;
    variant->visit_bounds(worst);
    const Examination e = examined("literal", scene);
    EXPECT_EQ(e.all.worst_shortfall, worst.most) << scene;
    double of_levels = 0;
    for (const LevelExamined& level : e.levels) of_levels = std::max(of_levels, level.worst_shortfall);
    EXPECT_EQ(of_levels, worst.most) << scene;
    EXPECT_EQ(e.all.failing, worst.failing.size()) << scene;
    EXPECT_LT(e.all.failing, e.all.parents) << scene;
  }
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
