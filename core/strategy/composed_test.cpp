#include "catena/core/strategy/composed.h"

#include <gtest/gtest.h>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

/// Counts as many levels as spheres, as a tree grown by insertion in chain order has.
class Tall final : public Construction<HierarchyView<Sphere>> {
 public:
  void build(const ChainView& chain) override { tree_.height = chain.size; }
  HierarchyView<Sphere> hierarchy() const override { return tree_; }

 private:
  HierarchyView<Sphere> tree_{};
};

class NoTraversal final : public Traversal<HierarchyView<Sphere>> {
  void find(const ChainView&, const HierarchyView<Sphere>&, const Request&, Collisions&) override {}
};

TEST(Composed, RefusesAHierarchyHigherThanTheTraversalsStacks) {
  Composed<HierarchyView<Sphere>> variant(std::make_unique<Tall>(), Place::host(),
                                          std::make_unique<NoTraversal>(), Place::host(), nullptr);
  const auto chain = [](std::uint32_t n) { return Chain(std::vector<Sphere>(n, Sphere{0, 0, 0, 1})); };
  EXPECT_NO_THROW(variant.build(chain(max_hierarchy_height)));
  try {
    variant.build(chain(max_hierarchy_height + 1));
    FAIL() << "a stack of 64 would have held 65 levels";
  } catch (const CapacityError& error) {
    EXPECT_STREQ(error.what(),
                 "the hierarchy has 65 levels, and traversals hold at most 64; use a construction that "
                 "balances, such as aCPU2");
  }
}

/// No tree stands after a build that threw: a search of it would read what was never written.
void expect_nothing_built(Variant& variant, const Chain& small, const Chain& refused) {
  Collisions found;
  variant.build(small);
  EXPECT_NO_THROW(variant.find(small, {}, found));
  EXPECT_THROW(variant.build(refused), CapacityError);
  EXPECT_THROW(variant.find(refused, {}, found), std::logic_error);
  EXPECT_THROW(variant.find(small, {}, found), std::logic_error);
  EXPECT_THROW(variant.update(refused), CapacityError);
  EXPECT_THROW(variant.find(refused, {}, found), std::logic_error);
  variant.build(small);
  EXPECT_NO_THROW(variant.find(small, {}, found));
}

TEST(Composed, HasNothingBuiltAfterABuildThatThrew) {
  const auto chain = [](std::uint32_t n) { return Chain(std::vector<Sphere>(n, Sphere{0, 0, 0, 1})); };
  expect_nothing_built(*StrategyRegistry::instance().make("bGPU2@host+CPU2"), chain(100), chain(2000));
  Composed<HierarchyView<Sphere>> tall(std::make_unique<Tall>(), Place::host(),
                                       std::make_unique<NoTraversal>(), Place::host(), nullptr);
  expect_nothing_built(tall, chain(10), chain(100));
}

}  // namespace
}  // namespace catena
