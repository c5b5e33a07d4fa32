#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/properties/property.h"
#include "catena/properties/testing/certified.h"
#include "catena/reference/compare.h"

// The general baselines, which know nothing of chains, beyond what every variant is asked: proofs of longer
// answers, other leaves, and the trees that are hard for them.
namespace catena::properties {
namespace {

TEST(Baselines, AreCertified) {
  for (const char* name : {"MedianSplit+Half", "LBVH+Half", "SweepAndPrune"}) expect_certified(name);
}

Collisions found_by(Variant& variant, const Chain& chain) {
  Collisions found;
  variant.build(chain);
  variant.find(chain, {}, found);
  return found;
}

TEST(Baselines, LeavesOfAnySizeGiveThePairs) {
  const Chain chain = open_input("yarn:n=2000").animation->frame(0);
  const auto exact = reference::find(chain);
  ASSERT_GT(exact.pair_count, 1000u);
  for (const char* construction : {"MedianSplit", "LBVH"})
    for (const char* leaf : {"1", "3", "1024"}) {
      const std::string name = std::string(construction) + "(leaf=" + leaf + ")+Half";
      const auto variant = StrategyRegistry::instance().make(name);
      EXPECT_TRUE(reference::compare(chain, exact, found_by(*variant, chain)).right()) << name;
    }
}

struct Levels final : BoundsVisitor {
  void tree(const TreeFacts& facts) override { levels = facts.levels; }
  void edge(std::uint32_t, const AnyBound&, std::uint32_t, const AnyBound&) override {}
  std::uint32_t levels = 0;
};

/// Spheres at powers of two, three axes in turn: each halving of space parts one from the others, so that
/// Morton codes make a tree nearly as deep as they have bits, and every pair overlaps. No stack may be too
/// small for it.
TEST(Baselines, TheDeepestTreeOfMortonCodesLosesNothing) {
  std::vector<Sphere> spheres;
  for (int exponent = 0; exponent < 21; ++exponent) {
    const float at = std::ldexp(1.0f, -exponent);
    spheres.insert(spheres.end(), {{at, 0, 0, 2}, {0, at, 0, 2}, {0, 0, at, 2}});
  }
  spheres.push_back({0, 0, 0, 2});
  const Chain chain(spheres);
  const auto variant = StrategyRegistry::instance().make("LBVH(leaf=1)+Half");
  EXPECT_TRUE(reference::compare(chain, reference::find(chain), found_by(*variant, chain)).right());
  Levels deep;
  variant->visit_bounds(deep);
  EXPECT_GT(deep.levels, 60u);
}

/// What moves far is not mended but sorted anew, and along another axis where centres then vary most.
TEST(Baselines, SweepAndPruneTurnsWithTheChain) {
  std::vector<Sphere> spheres;
  for (int i = 0; i < 400; ++i) spheres.push_back({float(i % 200), float(i % 3) / 4, 0, 0.4f});
  const Chain along(spheres);
  const auto variant = StrategyRegistry::instance().make("SweepAndPrune");
  variant->build(along);
  for (const bool backwards : {false, true}) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const Sphere& s = along[static_cast<std::uint32_t>(i)];
      spheres[i] = {s.z, backwards ? -s.x : s.x, s.y, s.radius};
    }
    const Chain moved = along.moved(spheres);
    variant->update(moved);
    Collisions found;
    variant->find(moved, {}, found);
    EXPECT_TRUE(reference::compare(moved, reference::find(moved), found).right()) << backwards;
    EXPECT_GT(found.pair_count, 100u);
  }
}

}  // namespace
}  // namespace catena::properties
