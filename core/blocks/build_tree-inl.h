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

/// Children of sixteen nodes, lane = node: child b of each from field[b] on, laid out as one Sixteen. Where a
/// node has fewer than sixteen, or there are fewer nodes, the last stands for what is missing.
template <class Sixteen>
struct ChildrenOfNodes {
  static constexpr std::uint32_t group = BlockTree::group;
  alignas(64) float field[group][Sixteen::fields][group];

  /// From `nodes` groups of sixteen, one after the other.
  HWY_INLINE ChildrenOfNodes(const float* groups, std::uint32_t nodes, std::uint32_t children_of_last) {
    constexpr std::size_t stride = std::size_t{group} * Sixteen::fields;
    alignas(64) float copies[group * stride];
    if (nodes < group || children_of_last < group) {
      for (std::uint32_t k = 0; k < group; ++k) {
        const std::uint32_t node = std::min(k, nodes - 1), used = node + 1 < nodes ? group : children_of_last;
        for (std::uint32_t f = 0; f < Sixteen::fields; ++f)
          for (std::uint32_t b = 0; b < group; ++b)
            copies[k * stride + f * group + b] = groups[node * stride + f * group + std::min(b, used - 1)];
      }
      groups = copies;
    }
    for (std::uint32_t f = 0; f < Sixteen::fields; ++f) {
      for (std::uint32_t b = 0; b < group; b += 4) {
        Lanes16 four[4];
        transpose(groups + f * group + b, stride, four);
        for (std::uint32_t k = 0; k < 4; ++k) four[k].store(field[b + k][f]);
      }
    }
  }
  HWY_INLINE Sixteen child(std::uint32_t b) const { return Sixteen::load(field[b][0]); }
  HWY_INLINE Vectors centre(std::uint32_t b) const { return Vectors::load(field[b][0]); }
};

/// Axes for sixteen nodes and a guess of their centres, from the centres of their children.
template <class Sixteen>
HWY_INLINE OrientedBoxes guess(const ChildrenOfNodes<Sixteen>& children) {
  constexpr std::uint32_t group = BlockTree::group;
  const Vectors origin = children.centre(0);
  Vectors sum = origin - origin;
  Symmetric square{sum.x, sum.x, sum.x, sum.x, sum.x, sum.x};
  for (std::uint32_t b = 1; b < group; ++b) {
    const Vectors p = children.centre(b) - origin;
    sum = sum + p;
    square = {mul_add(p.x, p.x, square.xx), mul_add(p.x, p.y, square.xy), mul_add(p.x, p.z, square.xz),
              mul_add(p.y, p.y, square.yy), mul_add(p.y, p.z, square.yz), mul_add(p.z, p.z, square.zz)};
  }
  const Vectors mean = scaled(sum, Lanes16::all(1.0f / group));
  OrientedBoxes result;
  principal_axes({neg_mul_add(sum.x, mean.x, square.xx), neg_mul_add(sum.x, mean.y, square.xy),
                  neg_mul_add(sum.x, mean.z, square.xz), neg_mul_add(sum.y, mean.y, square.yy),
                  neg_mul_add(sum.y, mean.z, square.yz), neg_mul_add(sum.z, mean.z, square.zz)},
                 result.axis);
  result.centre = origin + mean;
  return result;
}

/// Moves the centres to the middle of the children and fits the half sides.
template <class Sixteen>
HWY_INLINE void fit(const ChildrenOfNodes<Sixteen>& children, OrientedBoxes& boxes) {
  constexpr std::uint32_t group = BlockTree::group;
  Intervals all = intervals(children.child(0), boxes.centre, boxes.axis);
  for (std::uint32_t b = 1; b < group; ++b) {
    const Intervals child = intervals(children.child(b), boxes.centre, boxes.axis);
    for (int k = 0; k < 3; ++k)
      all.low[k] = min(all.low[k], child.low[k]), all.high[k] = max(all.high[k], child.high[k]);
  }
  for (int k = 0; k < 3; ++k)
    boxes.centre = plus(boxes.centre, Lanes16::all(0.5f) * (all.low[k] + all.high[k]), boxes.axis[k]);
  // Measured again from the centres as they are stored.
  const Lanes16 zero = Lanes16::all(0);
  for (int k = 0; k < 3; ++k) boxes.half[k] = zero;
  for (std::uint32_t b = 0; b < group; ++b) {
    const Intervals child = intervals(children.child(b), boxes.centre, boxes.axis);
    for (int k = 0; k < 3; ++k) boxes.half[k] = max(boxes.half[k], max(child.high[k], zero - child.low[k]));
  }
}

/// The boxes of nodes first to first + 15 of level l, as far as there are so many.
template <class Sixteen>
HWY_INLINE void build_nodes(const float* children, std::uint32_t nodes, std::uint32_t children_of_last,
                            float* to) {
  const ChildrenOfNodes<Sixteen> below(children, nodes, children_of_last);
  OrientedBoxes boxes = guess(below);
  fit(below, boxes);
  boxes.store(to);
}

/// The boxes of nodes begin to end - 1 of level l, both multiples of sixteen or the last, from their
/// children's.
HWY_INLINE void build_level(BlockTree& tree, std::size_t l, std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t group = BlockTree::group;
  BlockTree::Level& level = tree.level[l];
  for (std::uint32_t k = begin; k < end; k += group) {
    const std::uint32_t nodes = std::min(group, level.count - k),
                        of_last = tree.children_of(l, k + nodes - 1);
    if (l == 0)
      build_nodes<Capsules>(tree.capsules_of(k), nodes, of_last, level.at(k));
    else
      build_nodes<OrientedBoxes>(tree.level[l - 1].at(k * group), nodes, of_last, level.at(k));
  }
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
