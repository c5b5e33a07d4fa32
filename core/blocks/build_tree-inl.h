// Nodes over groups of blocks, and boxes over nodes up to one.
#if defined(CATENA_CORE_BLOCKS_BUILD_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#undef CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#else
#define CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#endif

#include "catena/core/blocks/build_blocks-inl.h"
#include "catena/core/blocks/oriented_boxes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Axes for nodes first .. first + 15 and a guess of their centres, lane = node, from the centres of their blocks.
HWY_INLINE void guess_oriented(const BlockTree& tree, std::uint32_t first, float* to) {
  constexpr std::uint32_t group = BlockTree::group;
  alignas(64) float centres[group][3][group];  // [block][coordinate][node]
  for (std::uint32_t lane = 0; lane < group; ++lane) {
    const std::uint32_t node = std::min(first + lane, static_cast<std::uint32_t>(tree.node_group.size()) - 1);
    const std::uint32_t g = tree.node_group[node], last = tree.blocks_of(g) - 1;
    const float* const fields = tree.capsules_of(g);
    for (std::uint32_t b = 0; b < group; ++b)
      for (std::uint32_t d = 0; d < 3; ++d) centres[b][d][lane] = fields[group * d + std::min(b, last)];
  }
  const Vectors origin = Vectors::load(centres[0][0]);
  Vectors sum = origin - origin;
  Symmetric square{sum.x, sum.x, sum.x, sum.x, sum.x, sum.x};
  for (std::uint32_t b = 1; b < group; ++b) {
    const Vectors p = Vectors::load(centres[b][0]) - origin;
    sum = sum + p;
    square = {mul_add(p.x, p.x, square.xx), mul_add(p.x, p.y, square.xy), mul_add(p.x, p.z, square.xz),
              mul_add(p.y, p.y, square.yy), mul_add(p.y, p.z, square.yz), mul_add(p.z, p.z, square.zz)};
  }
  const Vectors mean = scaled(sum, Lanes16::all(1.0f / group));
  Vectors axis[3];
  principal_axes({neg_mul_add(sum.x, mean.x, square.xx), neg_mul_add(sum.x, mean.y, square.xy),
                  neg_mul_add(sum.x, mean.z, square.xz), neg_mul_add(sum.y, mean.y, square.yy),
                  neg_mul_add(sum.y, mean.z, square.yz), neg_mul_add(sum.z, mean.z, square.zz)},
                 axis);
  (origin + mean).store(to);
  for (int k = 0; k < 3; ++k) axis[k].store(to + 48 + 48 * k);
}

/// Both boxes of the nodes of tree.node_group.
HWY_INLINE void build_nodes(BlockTree& tree) {
  const auto nodes = static_cast<std::uint32_t>(tree.node_group.size());
  BlockTree::Level& level = tree.level[0];
  for (std::uint32_t k = 0; k < nodes; ++k) {
    const std::uint32_t lane = k % BlockTree::group;
    float* const oriented = tree.oriented.data() + std::size_t{k - lane} * BlockTree::oriented_fields;
    if (lane == 0) guess_oriented(tree, k, oriented);
    const std::uint32_t used = tree.blocks_of(tree.node_group[k]);
    const Capsules capsules = Capsules::load(tree.capsules_of(tree.node_group[k]));
    fit(capsules, used, oriented, lane);
    enclose(boxes_around(capsules), used, level.boxes.data() + std::size_t{k - lane} * BlockTree::box_fields, lane);
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
