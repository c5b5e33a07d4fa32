#include "catena/core/hierarchy/level.h"

#include <gtest/gtest.h>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/executor/host_group.h"
#include "catena/core/policies/aGPU2.h"

namespace catena {
namespace {

TEST(Level, SevenLeavesGiveTheTreeOfTheDesign) {
  // e8(e1,e2) e9(e3,e4) e10(e5,e6) e11(e8,e9) e12(e10,e7) e13(e11,e12), counted from 1.
  const std::vector<Links> expected{{0, 1}, {2, 3}, {4, 5}, {7, 8}, {9, 6}, {10, 11}};
  Hierarchy<Sphere> storage;
  HierarchyView<Sphere> tree = storage.reset(7);
  for (std::uint32_t i = 0; i < 7; ++i) tree.bound[i] = {float(i), 0, 0, 1}, tree.links[i] = Links::of_leaf();
  HostGroup group(4);
  policy::bGPU2<Robust>::build(group, tree, Level::leaves(7), 7, 12);
  EXPECT_EQ(std::vector<Links>(tree.links + 7, tree.links + 13), expected);
}

TEST(Level, HalvingsAreTheCeilingOfTheLogarithm) {
  EXPECT_EQ(halvings(1), 0u);
  for (std::uint32_t k = 1; k < 31; ++k) {
    EXPECT_EQ(halvings((1u << k)), k);
    EXPECT_EQ(halvings((1u << k) + 1), k + 1);
  }
}

/// Fig. 10: leaves, inner nodes of the subtrees, their roots, then the top; every slot used once.
TEST(SubtreeStage, SlotsFollowFigure10) {
  for (std::uint32_t n : {1u, 2u, 3u, 8u, 9u, 10u, 17u, 64u, 65u, 100u}) {
    const policy::SubtreeStage stage(Level::leaves(n), n, 8);
    std::vector<int> used(2 * n, 0);
    const auto take = [&](std::uint32_t slot) { ++used.at(slot - n); };
    for (std::uint32_t s = 0; s < stage.subtrees(); ++s) {
      const std::uint32_t size = stage.nodes(s).size;
      for (std::uint32_t k = 0; k + 2 < size; ++k) take(stage.first_inner(s) + k);
      if (size > 1) take(stage.root_slot(s));
      EXPECT_EQ(stage.roots().node(s), size > 1 ? stage.root_slot(s) : n - 1) << n;
      if (size > 1) {
        EXPECT_GE(stage.root_slot(s), stage.roots().first) << "roots lie together";
      }
    }
    for (std::uint32_t slot = n; slot < stage.end(); ++slot) EXPECT_EQ(used[slot - n], 1) << n << ' ' << slot;
  }
}

/// Stages follow until one block holds their roots; the top ends with the last slot of the tree, and there is
/// none where one root is left.
TEST(SubtreeStage, FollowsWhileABlockDoesNotHoldItsRoots) {
  for (const std::uint32_t subtree : {2u, 3u, 8u})
    for (const std::uint32_t block : {2u, 3u, 4u})
      for (std::uint32_t n = 1; n <= 150; ++n) {
        HierarchyView<Sphere> tree{};
        tree.leaves = n;
        std::uint32_t roots = n, stages = 0, tops = 0;
        policy::aGPU2<Robust>::build(
            tree, subtree, block,
            [&](const policy::SubtreeStage& stage) {
              EXPECT_TRUE(stages++ == 0 || roots > block) << n;
              EXPECT_EQ(stage.subtrees(), (roots + subtree - 1) / subtree);
              roots = stage.subtrees();
            },
            [&](const Level& level, std::uint32_t next, std::uint32_t root_slot) {
              ++tops;
              EXPECT_EQ(level.size, roots);
              EXPECT_GT(level.size, 1u);
              EXPECT_EQ(next + level.size - 2, root_slot);
            });
        EXPECT_LE(roots, block) << n;
        EXPECT_EQ(tops, roots > 1 ? 1u : 0u) << n;
        EXPECT_EQ(tree.root, 2 * n - 2);
      }
}

TEST(HostGroup, AMissingBarrierIsSeenEveryTime) {
  int data[8] = {}, copy[8] = {};
  int* const d = data;
  int* const c = copy;
  const auto run = [&](bool barrier) {
    std::fill(data, data + 8, 0);
    HostGroup group(8);
    group.parallel(8, [=](std::uint32_t k) { d[k] = int(k) + 1; });
    if (barrier) group.barrier();
    group.parallel(8, [=](std::uint32_t k) { c[k] = d[(k + 7) % 8]; });  // the thread before
    group.barrier();
    return copy[1] == 1 && copy[7] == 7;
  };
  EXPECT_TRUE(run(true));
  EXPECT_FALSE(run(false));
}

}  // namespace
}  // namespace catena
