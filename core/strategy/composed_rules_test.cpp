#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/test_registry.h"

/// What composes with what, by its words; and a composed variant from chain to chain of other sizes.
namespace catena {
namespace {

using test::refusal, test::registry;

TEST(Registry, ListsVariantsByName) {
  for (const bool hidden : {false, true})
    EXPECT_TRUE(std::ranges::is_sorted(registry().variants(hidden), {}, &VariantInfo::name));
}

TEST(Registry, SaysWhichArithmeticsAndPartnersThereAre) {
  EXPECT_EQ(refusal("CPU1/exact"), "'CPU1' has no exact arithmetic; it has: double, literal, robust");
  const std::string other = refusal("Boxes+CPU2");
  EXPECT_TRUE(other.starts_with("CPU2 takes another tree than Boxes makes; with Boxes go: ")) << other;
  EXPECT_NE(other.find("BoxesAgainstBoxes"), std::string::npos) << other;
  EXPECT_EQ(other.find("GPU2"), std::string::npos) << other;
  const std::string device =
      "; catena is built without devices here, and 'aGPU2@host' runs the same on the host";
  if (registry().find_strategy("aGPU2") == nullptr) {
    EXPECT_TRUE(refusal("aGPU2+CPU2").ends_with(device)) << refusal("aGPU2+CPU2");
  }
}

struct CountEdges final : BoundsVisitor {
  void edge(std::uint32_t, const AnyBound&, std::uint32_t, const AnyBound&) override { ++edges; }
  std::size_t edges = 0;
};

TEST(Composed, AnUpdateOfAnotherSizeIsABuild) {
  const auto variant = registry().make("aCPU2+CPU2");
  CountEdges none;
  variant->visit_bounds(none);
  EXPECT_EQ(none.edges, 0u) << "nothing is built";
  for (const std::uint32_t n : {50u, 20u, 90u, 90u}) {
    const Chain chain = open_input("winding:n=" + std::to_string(n)).animation->frame(0);
    variant->update(chain);
    Collisions found, exact;
    variant->find(chain, {}, found);
    const auto all = registry().make("CPU1");
    all->build(chain);
    all->find(chain, {}, exact);
    std::ranges::sort(found.pairs), std::ranges::sort(exact.pairs);
    EXPECT_EQ(found.pairs, exact.pairs) << n;
    EXPECT_EQ(found.count, exact.count) << n;
    CountEdges shown;
    variant->visit_bounds(shown);
    EXPECT_EQ(shown.edges, 2u * n - 2) << "a node above each but the root";
  }
}

}  // namespace
}  // namespace catena
