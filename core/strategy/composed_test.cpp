#include "catena/core/strategy/composed.h"

#include <gtest/gtest.h>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"

namespace catena {
namespace {

/// Sphere i beside all before it: as many levels as spheres.
class Vine final : public Construction<Sphere> {
 public:
  void build(const ChainView& chain) override {
    tree_ = storage_.reset(chain.size);
    tree_.height = chain.size;
    tree_.root = tree_.size() - 1;
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      tree_.bound[i] = chain.spheres[i];
      tree_.links[i] = Links::of_leaf();
    }
    for (std::uint32_t i = 1; i < chain.size; ++i) {
      const std::uint32_t slot = chain.size + i - 1, before = i == 1 ? 0 : slot - 1;
      tree_.links[slot] = {before, i};
      tree_.bound[slot] = Robust::parent(tree_.bound[before], tree_.bound[i]);
    }
  }
  HierarchyView<Sphere> hierarchy() const override { return tree_; }

 private:
  Hierarchy<Sphere> storage_;
  HierarchyView<Sphere> tree_{};
};

class NoTraversal final : public Traversal<Sphere> {
  void find(const ChainView&, const HierarchyView<Sphere>&, const Request&, Collisions&) override {}
};

TEST(Composed, RefusesAHierarchyHigherThanTheTraversalsStacks) {
  Composed<Robust> variant(std::make_unique<Vine>(), Space::host, std::make_unique<NoTraversal>(),
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
