// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/blocks/build_blocks.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include <atomic>
#include <span>

#include "catena/core/blocks/block_kernels.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/blocks/build_tree-inl.h"
#include "catena/core/blocks/scaled_spheres-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

void build_groups_here(const ChainView& chain, BlockTree& tree, std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t ahead = 2;
  for (std::uint32_t g = begin; g < end; ++g) {
    if (g + ahead < end) fetch_group(chain, tree, g + ahead);
    build_group(chain, tree, g);
  }
}
bool scale_spheres_here(std::span<const Sphere> spheres, float by, Sphere* to) {
  return scale_spheres(spheres, by, to);
}
void build_level_here(BlockTree& tree, std::size_t l, std::uint32_t begin, std::uint32_t end) {
  build_level(tree, l, begin, end);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(build_groups_here);
HWY_EXPORT(build_level_here);
HWY_EXPORT(scale_spheres_here);

namespace {

/// Squares out of range keep their digits in units of the tree, and every step after is that of other chains.
void scale_chain(const ChainView& chain, BlockTree& tree, const Team& team) {
  constexpr std::uint32_t spheres_of_a_task = 1 << 12;
  if (tree.scaled.empty()) return;
  std::atomic<bool> exact{true};
  team.for_each_range(chain.size, spheres_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
    if (!HWY_DYNAMIC_DISPATCH(scale_spheres_here)({chain.spheres + begin, end - begin}, tree.scale,
                                                  tree.scaled.data() + begin))
      exact.store(false, std::memory_order_relaxed);
  });
  if (!exact) tree.scaled.clear();
}

}  // namespace

void build_block_tree(const ChainView& chain, BlockTree& tree, const Team& team) {
  constexpr std::uint32_t nodes_of_a_task = 32;  // some ten microseconds
  lay_out_blocks(chain, tree);
  if (tree.blocks == 0) return;
  scale_chain(chain, tree, team);
  fill_tail(chain, tree);
  team.for_each_range(tree.level[0].count, nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
    HWY_DYNAMIC_DISPATCH(build_groups_here)(chain, tree, begin, end);
  });
  for (std::size_t l = 0; l < tree.level.size(); ++l) {
    const std::uint32_t count = tree.level[l].count,
                        groups = (count + BlockTree::group - 1) / BlockTree::group;
    team.for_each_range(groups, nodes_of_a_task / BlockTree::group,
                        [&](std::uint32_t begin, std::uint32_t end) {
                          HWY_DYNAMIC_DISPATCH(build_level_here)
                          (tree, l, begin * BlockTree::group, std::min(count, end * BlockTree::group));
                        });
  }
}

}  // namespace catena
#endif
