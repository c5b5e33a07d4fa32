#include "catena/reference/bound_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "catena/reference/bounds.h"

namespace catena::reference {
namespace {

Chain row(std::uint32_t n) {
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) spheres.push_back({static_cast<float>(i), 0, 0, 0.5f});
  return Chain(std::move(spheres));
}

/// Of trees that promise no more than that spheres are in the bounds of all their ancestors: whoever sticks
/// out of the node above, or has a sphere that does, is counted once, on whatever level.
TEST(BoundTree, CountsWhoHasASphereOutsideOfTheNodeAboveIt) {
  std::mt19937 dice(6);
  const auto below = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(dice() % limit); };
  std::size_t faulty = 0;
  for (int k = 0; k < 500; ++k) {
    const std::uint32_t n = 2 + below(10);
    const Chain chain = row(n);
    // Each node but the last goes below a later one, so that the last is the root.
    const std::uint32_t inner = 1 + below(5), root = n + inner - 1;
    std::vector<std::uint32_t> parent(root);
    std::vector<AnyBound> bound(root + 1);
    for (std::uint32_t id = 0; id <= root; ++id) {
      if (id < root) parent[id] = std::max(n, id + 1) + below(root + 1 - std::max(n, id + 1));
      const double at = below(n), wide = 1 + below(2 * n);
      if (id < n)
        bound[id] = Sphere64{chain[id].x, 0, 0, 0.5};
      else if (below(4) == 0)
        bound[id] = Everything{};
      else if (below(2) == 0)
        bound[id] = Sphere64{at, 0, 0, wide};
      else
        bound[id] = Box64{{at - wide, -1, -1}, {at + wide, 1, 1}};
    }
    BoundTree tree(chain);
    tree.begin_tree();
    std::vector<std::uint32_t> order(root);
    for (std::uint32_t id = 0; id < root; ++id) order[id] = id;
    std::ranges::shuffle(order, dice);
    for (const std::uint32_t id : order) tree.add(parent[id], bound[parent[id]], id, bound[id]);
    tree.check(false);

    std::vector<bool> sticks_out(root + 1, false);
    double worst = 0;
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t at = i; at != root; at = parent[at])
        if (!contains(bound[parent[at]], chain[i]))
          sticks_out[at] = true, worst = std::max(worst, shortfall(bound[parent[at]], chain[i]));
    const auto expected = static_cast<std::uint64_t>(std::ranges::count(sticks_out, true));
    faulty += expected > 0;
    EXPECT_EQ(tree.faults().unenclosed, expected) << k;
    EXPECT_EQ(tree.faults().worst_shortfall, worst) << k;
    EXPECT_EQ(tree.faults().misplaced, 0u) << k;
    EXPECT_EQ(tree.faults().bounds, root);
  }
  EXPECT_GT(faulty, 100u);
  EXPECT_LT(faulty, 490u);
}

TEST(BoundTree, MisplacesNodesInACycle) {
  const Chain chain = row(2);
  for (const bool nested : {false, true}) {
    BoundTree tree(chain);
    tree.begin_tree();
    tree.add(2, Everything{}, 0, Everything{});
    tree.add(3, Everything{}, 4, Everything{}), tree.add(4, Everything{}, 3, Everything{});
    tree.check(nested);
    EXPECT_EQ(tree.faults().misplaced, 2u);
  }
}

TEST(BoundTree, MisplacesANodeShownWithSlabsThatDiffer) {
  const Chain chain = row(2);
  const std::vector<Slab> slabs{{{1, 0, 0}, -9, 9}}, others{{{1, 0, 0}, -9, 9.5}};
  for (const auto& [second, same] : {std::pair{Slabs64{{0, 0, 0}, slabs}, true},
                                     {Slabs64{{0, 0, 1}, slabs}, false},
                                     {Slabs64{{0, 0, 0}, others}, false}}) {
    BoundTree tree(chain);
    tree.begin_tree();
    tree.add(2, Slabs64{{0, 0, 0}, slabs}, 0, Everything{}), tree.add(2, second, 1, Everything{});
    tree.check(false);
    EXPECT_EQ(tree.faults().misplaced, same ? 0u : 1u);
  }
}

/// Shown as one kind, then as another; below a leaf; with a number that no tree of so many spheres has.
TEST(BoundTree, MisplacesWhatHasNoOnePlaceAndBound) {
  const Chain chain = row(2);
  const Sphere64 leaf{0, 0, 0, 0.5};
  const auto misplaced = [&](const std::vector<std::pair<std::uint32_t, AnyBound>>& parents,
                             std::uint32_t child) {
    BoundTree tree(chain);
    tree.begin_tree();
    std::uint32_t below = 0;
    for (const auto& [parent, bound] : parents)
      tree.add(parent, bound, below++ == 0 ? 0 : child, Everything{});
    tree.check(false);
    return tree.faults().misplaced;
  };
  const Capsule64 capsule{{0, 0, 0}, {1, 0, 0}, 9};
  const Box64 box{{-9, -9, -9}, {9, 9, 9}};
  EXPECT_EQ(misplaced({{2, box}, {2, box}}, 1), 0u);
  EXPECT_EQ(misplaced({{2, capsule}, {2, capsule}}, 1), 0u);
  EXPECT_EQ(misplaced({{2, box}, {2, capsule}}, 1), 1u);
  EXPECT_EQ(misplaced({{2, capsule}, {2, box}}, 1), 1u);
  EXPECT_EQ(misplaced({{2, box}, {2, Sphere64{0, 0, 0, 20}}}, 1), 1u);
  EXPECT_EQ(misplaced({{2, box}, {0, leaf}}, 1), 1u) << "a leaf has nothing below it";
  EXPECT_EQ(misplaced({{15, box}, {15, box}}, 1), 0u);
  EXPECT_EQ(misplaced({{2, box}, {16, box}}, 1), 1u) << "eight nodes a sphere";
}

}  // namespace
}  // namespace catena::reference
