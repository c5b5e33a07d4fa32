// Nodes over groups of blocks, and boxes over nodes up to one.
#if defined(CATENA_CORE_BLOCKS_BUILD_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#undef CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#else
#define CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#endif

#include "catena/core/blocks/build_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Box and capsule of the node that has the blocks of each group of tree.node_group.
HWY_INLINE void build_nodes(BlockTree& tree) {
  const auto nodes = static_cast<std::uint32_t>(tree.node_group.size());
  BlockTree::Level& level = tree.level[0];
  for (std::uint32_t k = 0; k < nodes; ++k) {
    const std::uint32_t g = tree.node_group[k], lane = k % BlockTree::group, used = tree.blocks_of(g);
    const float* const fields = tree.capsules_of(g);
    const Capsules capsules = Capsules::load(fields);
    enclose(boxes_around(capsules), used, level.boxes.data() + std::size_t{k - lane} * BlockTree::box_fields, lane);
    enclose(capsules, fields, used, tree.node_capsules.data() + std::size_t{k - lane} * BlockTree::capsule_fields, lane);
  }
}

/// Boxes of sixteen boxes of the level below, up to one.
HWY_INLINE void build_levels(BlockTree& tree) {
  for (std::size_t l = 1; l < tree.level.size(); ++l) {
    const BlockTree::Level& below = tree.level[l - 1];
    BlockTree::Level& level = tree.level[l];
    for (std::uint32_t k = 0; k < level.count; ++k) {
      const std::uint32_t begin = k * BlockTree::group, lane = k % BlockTree::group;
      enclose(Boxes::load(below.at(begin)), std::min(BlockTree::group, below.count - begin),
              level.boxes.data() + std::size_t{k - lane} * BlockTree::box_fields, lane);
    }
  }
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
