// Nodes over sixteen blocks each, over sixteen nodes each, and so on to one.
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

/// Axes for nodes first .. first + 15 of level l and a guess of their centres, lane = node, from the centres
/// of their children.
HWY_INLINE void guess_axes(const BlockTree& tree, std::size_t l, std::uint32_t first, float* to) {
  constexpr std::uint32_t group = BlockTree::group;
  alignas(64) float centres[group][3][group];  // [child][coordinate][node]
  for (std::uint32_t lane = 0; lane < group; ++lane) {
    const std::uint32_t k = std::min(first + lane, tree.level[l].count - 1),
                        last = tree.children_of(l, k) - 1;
    const float* const fields = l == 0 ? tree.capsules_of(k) : tree.level[l - 1].at(k * group);
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

/// The boxes of all nodes of level l, from its children's.
HWY_INLINE void build_level(BlockTree& tree, std::size_t l) {
  BlockTree::Level& level = tree.level[l];
  for (std::uint32_t k = 0; k < level.count; ++k) {
    const std::uint32_t lane = k % BlockTree::group, used = tree.children_of(l, k);
    float* const oriented = level.at(k);
    if (lane == 0) guess_axes(tree, l, k, oriented);
    if (l == 0)
      fit(Capsules::load(tree.capsules_of(k)), used, oriented, lane);
    else
      fit(OrientedBoxes::load(tree.level[l - 1].at(k * BlockTree::group)), used, oriented, lane);
  }
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
