// The pairs of nodes of a BlockTree that may have colliding spheres, from the root down.
#if defined(CATENA_CORE_BLOCKS_NODE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_NODE_WALK_INL_H
#undef CATENA_CORE_BLOCKS_NODE_WALK_INL_H
#else
#define CATENA_CORE_BLOCKS_NODE_WALK_INL_H
#endif

#include <algorithm>

#include "catena/core/blocks/oriented_boxes-inl.h"
#include "catena/core/executor/team.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// How far the children of `node` of level m reach along the axes of node `frame` of level l.
HWY_INLINE Intervals in_frame_of(const BlockTree& tree, std::size_t l, std::uint32_t frame, std::size_t m,
                                 std::uint32_t node) {
  auto box = OrientedBoxes::all(tree.level[l].at(frame), frame % BlockTree::group);
  return m == 0 ? intervals(Capsules::load(tree.capsules_of(node)), box.centre, box.axis)
                : intervals(OrientedBoxes::load(tree.level[m - 1].at(node * BlockTree::group)), box.centre,
                            box.axis);
}
/// Bits of those that reach into the box of `node` of level l, where that is the frame.
HWY_INLINE std::uint32_t meet(const Intervals& in_its_frame, const BlockTree& tree, std::size_t l,
                              std::uint32_t node) {
  return meet(in_its_frame, OrientedBoxes::all(tree.level[l].at(node), node % BlockTree::group).half);
}

/// Every child in turn; see NodeWalk.
struct InTurn {
  template <class Body>
  void for_each(std::uint32_t children, const Body& body) const {
    for_each_lane(children, body);
  }
};
/// Each child by any member of a team.
struct ByTeam {
  const Team& team;
  template <class Body>
  void for_each(std::uint32_t children, const Body& body) const {
    std::uint32_t list[BlockTree::group], count = 0;
    for_each_lane(children, [&](std::uint32_t k) { list[count++] = k; });
    team.for_each_range(count, 1, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin; k < end; ++k) body(list[k]);
    });
  }
};

/// Goes down a tree. Met has met(a, b), called once for each pair a < b of nodes of level 0 that may have
/// blocks that collide, but for a and a + 1 that are in a row, with left_out(level, a, b) and
/// left_out_group(level, a, k) which say that pairs below nodes a and b, or a and the children of k, are of
/// no interest, and stop(), which ends the walk. Sink as for BlockSearch. Order has for_each(children, body),
/// which goes through the children of a node above level 1.
template <class Met, class Sink, class Order = InTurn>
class NodeWalk {
 public:
  NodeWalk(const BlockTree& tree, Met& met, const Sink& sink, const Order& order = {})
      : tree_(tree), met_(met), sink_(sink), order_(order) {}

  void run() { within(tree_.level.size() - 1, 0); }

 private:
  static constexpr std::uint32_t group = BlockTree::group;

  /// All pairs of nodes of level 0 below node k of level l.
  void within(std::size_t l, std::uint32_t k) {
    if (l == 0 || met_.stop() || met_.left_out(l, k, k)) return;
    const std::uint32_t begin = k * group, count = tree_.children_of(l, k);
    if (tree_.in_a_row(l, k)) {
      sink_.in_a_row(l, k);
      for_each_child(l, lane_bits(count), [&](std::uint32_t i) {
        within(l - 1, begin + i);
        if (i + 1 < count) to_the_next(l - 1, begin + i);
      });
      return;
    }
    Intervals reach = in_frame_of(tree_, l, k, l, k);
    const StoredIntervals single(reach);
    for_each_child(l, lane_bits(count), [&](std::uint32_t i) {
      within(l - 1, begin + i);
      against(l - 1, begin + i, k, meet(single.all(i), reach), lane_bits(count) & ~((2u << i) - 1));
    });
  }

  /// Those of a node below node a of level l with one below the next. In a row these are only the last below
  /// the one and the first below the other.
  void to_the_next(std::size_t l, std::uint32_t a) {
    if (!tree_.with_the_next(l, a)) return between(l, a, a + 1);
    if (l == 0 || met_.left_out(l, a, a + 1)) return;
    sink_.with_the_next(l, a);
    to_the_next(l - 1, a * group + group - 1);
  }

  /// Those of a node below node a of level l with one below node b > a.
  void between(std::size_t l, std::uint32_t a, std::uint32_t b) {
    if (met_.stop() || met_.left_out(l, a, b)) return;
    if (l == 0) return met_.met(a, b);
    const std::uint32_t all_a = lane_bits(tree_.children_of(l, a)),
                        all_b = lane_bits(tree_.children_of(l, b));
    Intervals b_by_a = in_frame_of(tree_, l, a, l, b);
    const std::uint32_t theirs = meet(b_by_a, tree_, l, a) & all_b;
    for_each_lane(all_b & ~theirs, [&](std::uint32_t j) { sink_.child_apart(l, b * group + j, a); });
    if (theirs == 0) return;
    const std::uint32_t mine = meet(in_frame_of(tree_, l, b, l, a), tree_, l, b) & all_a;
    if (Sink::listens)
      for_each_lane(all_a & ~mine, [&](std::uint32_t i) { against(l - 1, a * group + i, b, 0, theirs); });
    if (mine == 0) return;
    const StoredIntervals a_by_a(in_frame_of(tree_, l, a, l, a));
    for_each_child(l, mine, [&](std::uint32_t i) {
      against(l - 1, a * group + i, b, meet(a_by_a.all(i), b_by_a), theirs);
    });
  }

  template <class Body>
  void for_each_child(std::size_t l, std::uint32_t children, const Body& body) const {
    if (l > 1)
      order_.for_each(children, body);
    else
      for_each_lane(children, body);
  }

  /// Node a of level l against the sixteen of group k in `candidates`, of which those in `near` may meet it.
  void against(std::size_t l, std::uint32_t a, std::uint32_t k, std::uint32_t near,
               std::uint32_t candidates) {
    if (met_.left_out_group(l, a, k)) return;
    near &= candidates;
    // A node and the next along the chain touch each other, so that a test would be in vain.
    const std::uint32_t next = a + 1 - k * group < group ? 1u << (a + 1 - k * group) & candidates : 0u;
    if ((near & ~next) != 0)
      near &= may_meet(OrientedBoxes::all(tree_.level[l].at(a), a % group),
                       OrientedBoxes::load(tree_.level[l].at(k * group))) |
              next;
    for_each_lane(candidates & ~near, [&](std::uint32_t j) { sink_.nodes_apart(l, a, k * group + j); });
    for_each_lane(near, [&](std::uint32_t j) {
      sink_.nodes_near(l, a, k * group + j);
      if (k * group + j == a + 1)
        to_the_next(l, a);
      else
        between(l, a, k * group + j);
    });
  }

  const BlockTree& tree_;
  Met& met_;
  const Sink& sink_;
  const Order order_;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
