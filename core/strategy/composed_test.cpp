#include "catena/core/strategy/composed.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"
#include "catena/core/hierarchy/sphere_bounds_visitor.h"
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

/// Says which was asked of it.
class Counting final : public Construction<HierarchyView<Sphere>> {
 public:
  explicit Counting(std::string& said) : said_(said) {}
  void build(const ChainView& chain) override { said_ += "build " + std::to_string(chain.size) + "; "; }
  void update(const ChainView& chain, const Moved&) override {
    said_ += "update " + std::to_string(chain.size) + "; ";
  }
  HierarchyView<Sphere> hierarchy() const override { return {}; }

 private:
  std::string& said_;
};

class Slow final : public Traversal<HierarchyView<Sphere>> {
  void find(const ChainView&, const HierarchyView<Sphere>&, const Request&, Collisions&) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
};

TEST(Composed, UpdatesWhatWasBuiltForAsManySpheresAndTimesWhatItDid) {
  const auto chain = [](std::uint32_t n) { return Chain(std::vector<Sphere>(n, Sphere{0, 0, 0, 1})); };
  std::string said;
  Composed<HierarchyView<Sphere>> variant(std::make_unique<Counting>(said), Place::host(),
                                          std::make_unique<Slow>(), Place::host(), nullptr);
  Variant& as_any = variant;
  as_any.update(chain(3)), as_any.update(chain(3)), as_any.update(chain(4)), as_any.update(chain(4));
  EXPECT_EQ(said, "build 3; update 3; build 4; update 4; ");
  Collisions found;
  variant.find(chain(4), {}, found);
  EXPECT_GE(variant.timings().find_ms, 2);
  as_any.update(chain(4));
  EXPECT_EQ(variant.timings().find_ms, 0) << "of an earlier frame";
}

/// A tree of two leaves, the first time; it keeps that one.
class Once final : public Construction<HierarchyView<Sphere>> {
 public:
  void build(const ChainView&) override {
    if (tree_.leaves != 0) throw CapacityError("a second time");
    tree_ = storage_.reset(2);
    for (std::uint32_t i = 0; i < 3; ++i) tree_.bound[i] = {0, 0, 0, 1}, tree_.links[i] = Links::of_leaf();
    tree_.links[2] = {0, 1};
    tree_.root = 2, tree_.height = 2;
  }
  HierarchyView<Sphere> hierarchy() const override { return tree_; }

 private:
  Hierarchy<Sphere> storage_;
  HierarchyView<Sphere> tree_{};
};

TEST(Composed, ShowsNoBoundsAfterABuildThatThrew) {
  struct Nodes final : SphereBoundsVisitor {
    void sphere(std::uint32_t, const Sphere64&, std::uint32_t, const Sphere64&) override { ++shown; }
    int shown = 0;
  } nodes;
  const Chain chain(std::vector<Sphere>(2, Sphere{0, 0, 0, 1}));
  Composed<HierarchyView<Sphere>> variant(std::make_unique<Once>(), Place::host(),
                                          std::make_unique<NoTraversal>(), Place::host(), nullptr);
  variant.build(chain);
  variant.visit_bounds(nodes);
  EXPECT_EQ(std::exchange(nodes.shown, 0), 2);
  EXPECT_THROW(variant.build(chain), CapacityError);
  variant.visit_bounds(nodes);
  EXPECT_EQ(nodes.shown, 0);
}

}  // namespace
}  // namespace catena
