// What a build keeps of what several threads gathered, and nothing of blocks that another search has.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/chain/chain.h"
#include "catena/core/hybrid/hybrid_search.h"
#include "catena/core/space_tree/space_kernels.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/family.h"

namespace catena {
namespace {

/// The spheres of each entry, by the block that it is of.
std::map<std::uint32_t, std::vector<std::vector<std::uint32_t>>> gathered(const Chain& chain,
                                                                          const Team& team) {
  BlockTree tree;
  Crowding crowding;
  SpaceTree space;
  std::vector<SpaceQueue> queues(team.size());
  build_block_tree(chain.view(), tree, team);
  find_crowds(chain.view(), tree, 0, crowding, team);
  build_space_tree(chain.view(), tree, crowding, space, {false, 1e6, 0}, queues, team);
  std::map<std::uint32_t, std::vector<std::vector<std::uint32_t>>> entries;
  for (std::uint32_t k = 0; k < space.entries; ++k) {
    auto& spheres = entries[space.whole[k]].emplace_back();
    for (std::uint32_t j = 0; j < BlockTree::block; ++j)
      if (const std::uint32_t i = tree.index(space.block[k], j); i != BlockTree::no_sphere)
        spheres.push_back(i);
  }
  for (auto& [block, parts] : entries) std::ranges::sort(parts);
  return entries;
}

/// Ropes of strands that are told as one chain: it jumps from each to the next, so that blocks are cut.
Chain ropes(std::uint32_t strands) {
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < strands; ++k)
    for (std::uint32_t i = 0; i < 37; ++i)
      spheres.push_back({static_cast<float>(i), static_cast<float>(k % 40) * 1.5f,
                         static_cast<float>(k / 40), 0.6f});
  return Chain(std::move(spheres));
}

TEST(SpaceTree, HoldsTheSameBlocksAndPartsForAnyTeam) {
  const Chain chain = ropes(1200);
  const auto alone = gathered(chain, Team());
  std::size_t cut = 0;
  for (const auto& [block, parts] : alone) cut += parts.size() > 1;
  ASSERT_GT(cut, 500u);
  for (const char* threads : {"threads=2", "threads=3", "threads=4"}) {
    const Team team(Parameters("test", {Team::threads_parameter()}, threads));
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(gathered(chain, team) == alone) << threads << ", time " << k;
  }
}

/// Blocks that are all dense are all left to the search of single spheres: no entry of them is left.
TEST(SpaceTree, IsEmptyWhereEveryBlockIsDense) {
  std::uint64_t seed = 70;
  int all = 0, some = 0;
  for (const properties::Family& family : properties::FamilyRegistry::instance().families())
    for (const std::uint32_t size : {400u, 2500u}) {
      properties::Dice dice(++seed);
      const Chain chain = properties::generate(family, dice, size);
      for (const double dense : {0.25, 0.4, 0.55, 0.7, 0.85, 1.0, 1.3}) {
        HybridSearch search({0, dense}, 1);
        search.build(chain.view(), Team());
        const HybridSearch::Parts& parts = search.parts();
        if (search.crowded_nodes() == 0) continue;
        bool each = true;
        for (std::uint32_t node = 0; node < search.nodes(); ++node)
          if (parts.crowding.crowded(node))
            for (std::uint32_t k = 0; k < parts.tree.blocks_of(node); ++k)
              each &= (parts.crowding.dense(node) >> k & 1) != 0;
        EXPECT_TRUE(!each || parts.space.entries == 0) << family.name << ' ' << size << ' ' << dense;
        ++(each ? all : some);
      }
    }
  EXPECT_GT(all, 10);
  EXPECT_GT(some, 10);
}

}  // namespace
}  // namespace catena
