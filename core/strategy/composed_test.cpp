#include "catena/core/strategy/composed.h"

#include <gtest/gtest.h>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"

namespace catena {
namespace {

/// Counts as many levels as spheres, as a tree grown by insertion in chain order has.
class Tall final : public Construction<Sphere> {
 public:
  void build(const ChainView& chain) override { tree_.height = chain.size; }
  HierarchyView<Sphere> hierarchy() const override { return tree_; }

 private:
  HierarchyView<Sphere> tree_{};
};

class NoTraversal final : public Traversal<Sphere> {
  void find(const ChainView&, const HierarchyView<Sphere>&, const Request&, Collisions&) override {}
};

TEST(Composed, RefusesAHierarchyHigherThanTheTraversalsStacks) {
  Composed<Robust> variant(std::make_unique<Tall>(), Space::host, std::make_unique<NoTraversal>(),
                           Space::host, nullptr);
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

}  // namespace
}  // namespace catena
