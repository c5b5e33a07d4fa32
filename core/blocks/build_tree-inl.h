// Nodes over sixteen blocks each, over sixteen nodes each, and so on to one.
#if defined(CATENA_CORE_BLOCKS_BUILD_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#undef CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#else
#define CATENA_CORE_BLOCKS_BUILD_TREE_INL_H
#endif

#include <algorithm>

#include "catena/core/blocks/build_blocks-inl.h"
#include "catena/core/blocks/node_axes-inl.h"
#include "catena/core/blocks/one_node-inl.h"
#include "catena/core/blocks/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Children of sixteen nodes, lane = node: child b of each from field[b] on, laid out as one Sixteen. Where a
/// node has fewer than sixteen, or there are fewer nodes, the last stands for what is missing.
template <class Sixteen>
struct ChildrenOfNodes {
  static constexpr std::uint32_t group = BlockTree::group;
  alignas(64) float field[group][Sixteen::fields][group];
  float past_the_last[group] = {};  ///< read by next_child, for no node

  /// From `nodes` groups of sixteen, one after the other.
  HWY_INLINE ChildrenOfNodes(const float* groups, std::uint32_t nodes, std::uint32_t children_of_last) {
    constexpr std::size_t stride = std::size_t{group} * Sixteen::fields;
    if (nodes == group && children_of_last == group) {
      transpose_all([=](std::size_t k) { return groups + k * stride; });
    } else {
      const float* const last = groups + (nodes - 1) * stride;
      alignas(64) float filled[stride];
      for (std::size_t f = 0; f < stride; f += group) {
        std::copy_n(last + f, children_of_last, filled + f);
        std::fill_n(filled + f + children_of_last, group - children_of_last, last[f + children_of_last - 1]);
      }
      transpose_all([&](std::size_t k) { return k + 1 < nodes ? groups + k * stride : filled; });
    }
  }
  HWY_INLINE Sixteen child(std::uint32_t b) const { return Sixteen::load(field[b][0]); }
  /// Child b of the next node; of the last lane's there is none.
  HWY_INLINE Sixteen next_child(std::uint32_t b) const { return Sixteen::load(field[b][0] + 1); }
  HWY_INLINE Vectors centre(std::uint32_t b) const { return Vectors::load(field[b][0]); }

 private:
  template <class Children>
  HWY_INLINE void transpose_all(const Children& children_of) {
    for (std::uint32_t f = 0; f < Sixteen::fields; ++f) {
      for (std::uint32_t b = 0; b < group; b += 4) {
        Lanes16 four[4];
        transpose_rows([&](std::size_t k) { return children_of(k) + f * group + b; }, four);
        for (std::uint32_t k = 0; k < 4; ++k) four[k].store(field[b + k][f]);
      }
    }
  }
};

/// Axes and a guess of the centres of sixteen nodes.
template <class Sixteen>
HWY_INLINE OrientedBoxes guess(const ChildrenOfNodes<Sixteen>& children) {
  Vectors origin = children.centre(0);
  Vectors sum = origin - origin;
  Symmetric square = Symmetric::least(), spread = plus_spread(Symmetric::least(), children.child(0));
  for (std::uint32_t b = 1; b < BlockTree::group; ++b) {
    Vectors p = children.centre(b) - origin;
    sum = sum + p;
    square = square.plus_square_of(p);
    spread = plus_spread(spread, children.child(b));
  }
  return box_guess(origin, sum, square, spread);
}

/// Moves the centres to the middle of the children.
template <class Sixteen>
HWY_INLINE void centre_on(const ChildrenOfNodes<Sixteen>& children, OrientedBoxes& boxes) {
  constexpr std::uint32_t group = BlockTree::group;
  Intervals all = intervals(children.child(0), boxes.centre, boxes.axis);
  for (std::uint32_t b = 1; b < group; ++b) {
    Intervals child = intervals(children.child(b), boxes.centre, boxes.axis);
    for (int k = 0; k < 3; ++k)
      all.low[k] = min(all.low[k], child.low[k]), all.high[k] = max(all.high[k], child.high[k]);
  }
  for (int k = 0; k < 3; ++k)
    boxes.centre = plus(boxes.centre, Lanes16::all(0.5f) * (all.low[k] + all.high[k]), boxes.axis[k]);
}

/// Bits of nodes whose children are in a row along the longest axis, and of those that are so together with
/// the children of the next.
struct RowBits {
  std::uint16_t alone, with_the_next;
};

/// Fits the half sides to the children, measured again from the centres as they are stored, and tells rows.
template <class Sixteen>
HWY_INLINE RowBits fit(const ChildrenOfNodes<Sixteen>& children, std::uint32_t nodes,
                       std::uint32_t children_of_last, OrientedBoxes& boxes) {
  constexpr std::uint32_t group = BlockTree::group;
  alignas(64) float size[group];
  for (std::uint32_t k = 0; k < group; ++k)
    size[k] = static_cast<float>(k + 1 < nodes ? group : children_of_last);
  Lanes16 zero = Lanes16::all(0), sizes = Lanes16::load(size);
  for (int k = 0; k < 3; ++k) boxes.half[k] = zero;
  const auto take = [&](std::uint32_t b) HWY_ATTR {
    Intervals child = intervals(children.child(b), boxes.centre, boxes.axis);
    for (int k = 0; k < 3; ++k) boxes.half[k] = max(boxes.half[k], max(child.high[k], zero - child.low[k]));
    return Interval{child.low[0], child.high[0]};
  };
  Rows rows(take(0));
  for (std::uint32_t b = 1; b < group; ++b) rows.add(take(b), sizes <= Lanes16::all(static_cast<float>(b)));
  const std::uint32_t alone = rows.bits() & lane_bits(nodes);
  if (alone == 0 || nodes < 2) return {static_cast<std::uint16_t>(alone), 0};
  for (std::uint32_t b = 0; b < group; ++b) {
    Interval child = reach_of(children.next_child(b), boxes.centre).along(boxes.axis[0]);
    if (b < 2)
      rows.add(child, zero < zero);
    else
      rows.add_further(child);
  }
  return {static_cast<std::uint16_t>(alone), static_cast<std::uint16_t>(rows.bits() & lane_bits(nodes - 1))};
}

/// The boxes of nodes first to first + 15 of level l, as far as there are so many.
template <class Sixteen>
HWY_INLINE RowBits build_nodes(const float* children, std::uint32_t nodes, std::uint32_t children_of_last,
                               float* to) {
  if (nodes == 1) return {build_one_node<Sixteen>(children, children_of_last, to), 0};
  const ChildrenOfNodes<Sixteen> below(children, nodes, children_of_last);
  OrientedBoxes boxes = guess(below);
  centre_on(below, boxes);
  const RowBits rows = fit(below, nodes, children_of_last, boxes);
  boxes.store(to);
  return rows;
}

/// The boxes of nodes begin to end - 1 of level l, both multiples of sixteen or the last, from their
/// children's.
HWY_INLINE void build_level(BlockTree& tree, std::size_t l, std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t group = BlockTree::group;
  BlockTree::Level& level = tree.level[l];
  for (std::uint32_t k = begin; k < end; k += group) {
    const std::uint32_t nodes = std::min(group, level.count - k),
                        of_last = tree.children_of(l, k + nodes - 1);
    const RowBits rows =
        l == 0 ? build_nodes<Capsules>(tree.capsules_of(k), nodes, of_last, level.at(k))
               : build_nodes<OrientedBoxes>(tree.level[l - 1].at(k * group), nodes, of_last, level.at(k));
    level.in_a_row[k / group] = rows.alone, level.with_the_next[k / group] = rows.with_the_next;
  }
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
