// The colliding pairs of a SphereTree: boxes of nodes, then spheres against the other node's box, then
// spheres.
#if defined(CATENA_CORE_SPHERE_TREE_SEARCH_SPHERE_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_SPHERE_TREE_SEARCH_SPHERE_TREE_INL_H
#undef CATENA_CORE_SPHERE_TREE_SEARCH_SPHERE_TREE_INL_H
#else
#define CATENA_CORE_SPHERE_TREE_SEARCH_SPHERE_TREE_INL_H
#endif

#include <algorithm>
#include <bit>

#include "catena/core/blocks/compress-inl.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/blocks/vector_hits-inl.h"
#include "catena/core/prefetch.h"
#include "catena/core/space_tree/axis_boxes-inl.h"
#include "catena/core/sphere_tree/sphere_evidence.h"
#include "catena/core/sphere_tree/sphere_queues.h"
#include "catena/core/sphere_tree/sphere_tree.h"
#include "catena/core/sphere_tree/turned_spheres-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Boxes around the spheres of a node. Rounding is monotone: an end that is apart from that of a box belongs
/// to a sphere that is.
HWY_INLINE AxisBoxes boxes_of_spheres(const float* fields) {
  Vectors at = Vectors::load(fields);
  Lanes16 radius = Lanes16::load(fields + 3 * SphereTree::group);
  return {{at.x - radius, at.y - radius, at.z - radius}, {at.x + radius, at.y + radius, at.z + radius}};
}

/// Found is as for VectorHits, and has satisfied(), true when nothing more is asked for. Sink has the members
/// of SphereEvidence; NoSphereEvidence costs nothing.
template <class Found, class Sink>
class SphereSearch {
 public:
  SphereSearch(const ChainView& chain, const SphereTree& tree, SphereQueues& queues, Found& found, Sink& sink)
      : tree_(tree),
        q_(queues),
        found_(found),
        sink_(sink),
        hits_(chain, queues.hits, tree.doubt, queues.open_done, found) {}

  /// Pairs within nodes begin to end - 1, and of these with later ones. Sixteen nodes that follow one another
  /// go down the tree together, as they meet about the same; but each alone where that is very much, which
  /// one of them may have made so.
  void run(std::uint32_t begin, std::uint32_t end) {
    const std::size_t top = tree_.boxes.size() - 1;
    for (std::uint32_t a = begin; a < end && !found_.satisfied();) {
      const bool together = gather(a / group);
      for (const std::uint32_t last = std::min(end, (a / group + 1) * group); a < last; ++a) {
        AxisBoxes box = box_of(a);
        within(a);
        together ? against_gathered(a, box) : down(top, 0, a, box);
        meet_nodes(a, box);
      }
    }
    work_off();
    hits_.finish();
  }

 private:
  static constexpr std::uint32_t group = SphereTree::group, box_fields = SphereTree::box_fields,
                                 vectors = group / sphere_lanes;  // of a node's spheres
  using Bits = hn::RebindToUnsigned<SphereTag>;

  HWY_INLINE AxisBoxes box_of(std::uint32_t node) const {
    return AxisBoxes::all(tree_.boxes_of(0, node / group), node % group);
  }
  /// Those of a node that are spheres.
  std::uint32_t there(std::uint32_t node) const { return lane_bits(tree_.spheres - node * group); }

  /// Those of group g of level l from number `first` of the level on.
  HWY_INLINE std::uint32_t from(std::size_t l, std::uint32_t g, std::uint32_t first) const {
    return lane_bits(tree_.count(l) - g * group) & ~(first > g * group ? lane_bits(first - g * group) : 0);
  }

  /// Queues the groups that have nodes which those of group g may meet, itself and later ones; false where
  /// these are too many, or there is one alone.
  bool gather(std::uint32_t g) {
    groups_ = 0;
    if (tree_.boxes.size() == 1) return false;
    AxisBoxes box = AxisBoxes::all(tree_.boxes_of(1, g / group), g % group);
    const std::size_t top = tree_.boxes.size() - 1;
    const auto take = [&](std::uint32_t other) {
      const float* const of = tree_.boxes_of(1, other / group) + other % group;
      float* const to = q_.boxes.data() + groups_ / group * group * box_fields + groups_ % group;
      for (std::uint32_t f = 0; f < box_fields; ++f) to[f * group] = of[f * group];
      q_.groups[groups_] = other;
      return ++groups_ < q_.groups.size();
    };
    if (!gather(top, 0, g, box, take, [](std::size_t, std::uint32_t) {})) return false;
    if constexpr (Sink::listens)
      gather(
          top, 0, g, box, [](std::uint32_t) { return true; },
          [&](std::size_t l, std::uint32_t k) { sink_.nodes_apart(1, g, l, k); });
    return true;
  }
  /// take(group) for those below group p of level l > 0, until it returns false.
  template <class Take, class Apart>
  bool gather(std::size_t l, std::uint32_t p, std::uint32_t g, const AxisBoxes& box, const Take& take,
              const Apart& apart) {
    const std::uint32_t later = from(l, p, g >> 4 * (l - 1));
    std::uint32_t met = later & meet(box, AxisBoxes::load(tree_.boxes_of(l, p))).bits();
    for_each_lane(later & ~met, [&](std::uint32_t k) { apart(l, p * group + k); });
    for (; met != 0; met &= met - 1) {
      const std::uint32_t child = p * group + static_cast<std::uint32_t>(std::countr_zero(met));
      if (!(l == 1 ? take(child) : gather(l - 1, child, g, box, take, apart))) return false;
    }
    return true;
  }

  /// Node a, in `box`, with later ones of the groups that are queued.
  void against_gathered(std::uint32_t a, const AxisBoxes& box) {
    for (std::uint32_t first = 0; first < groups_; first += group) {
      const std::uint32_t there = lane_bits(static_cast<std::uint32_t>(groups_) - first);
      const std::uint32_t met =
          there & meet(box, AxisBoxes::load(q_.boxes.data() + first * box_fields)).bits();
      if constexpr (Sink::listens)
        for_each_lane(there & ~met,
                      [&](std::uint32_t k) { sink_.nodes_apart(0, a, 1, q_.groups[first + k]); });
      for_each_lane(met, [&](std::uint32_t k) { against(q_.groups[first + k], a, box); });
    }
  }

  /// Node a, in `box`, with later ones below group g of level l.
  void down(std::size_t l, std::uint32_t g, std::uint32_t a, const AxisBoxes& box) {
    if (l == 0) return against(g, a, box);
    const std::uint32_t later = from(l, g, a >> 4 * l);
    const std::uint32_t met = later & meet(box, AxisBoxes::load(tree_.boxes_of(l, g))).bits();
    if constexpr (Sink::listens)
      for_each_lane(later & ~met, [&](std::uint32_t k) { sink_.nodes_apart(0, a, l, g * group + k); });
    for_each_lane(met, [&](std::uint32_t k) { down(l - 1, g * group + k, a, box); });
  }
  /// With later ones of group g.
  HWY_INLINE void against(std::uint32_t g, std::uint32_t a, const AxisBoxes& box) {
    const std::uint32_t first = g * group, later = from(0, g, a + 1);
    const std::uint32_t met = later & meet(box, AxisBoxes::load(tree_.boxes_of(0, g))).bits();
    if constexpr (Sink::listens)
      for_each_lane(later & ~met, [&](std::uint32_t k) { sink_.nodes_apart(0, a, 0, first + k); });
    for_each_lane(met, [&](std::uint32_t k) {
      const float* const fields = tree_.fields_of(first + k);
      for (std::uint32_t f = 0; f < SphereTree::sphere_fields; ++f) prefetch(fields + f * group);
      q_.nodes[nodes_++] = first + k;
    });
    if (nodes_ > SphereQueues::node_limit) meet_nodes(a, box);
  }

  /// All pairs of node a: its spheres against themselves turned by one lane, by two, and so on to eight.
  void within(std::uint32_t a) {
    if constexpr (Sink::listens)
      for_each_lane(there(a), [&](std::uint32_t p) {
        for_each_lane(there(a) & ~lane_bits(p + 1), [&](std::uint32_t k) {
          sink_.compared(tree_.index[a * group + p], tree_.index[a * group + k]);
        });
      });
    const TurnedSpheres spheres(tree_.fields_of(a), tree_.index.data() + a * group);
    spheres.meet(hits_);
    q_.tests_done += group / 2 * vectors;
  }

  /// Node a with those that are queued. Those of the one that the other's box meets are tested against all of
  /// the other: from the side that has fewer.
  void meet_nodes(std::uint32_t a, const AxisBoxes& box) {
    AxisBoxes spheres = boxes_of_spheres(tree_.fields_of(a));
    for (std::size_t k = 0; k < nodes_; ++k) {
      const std::uint32_t b = q_.nodes[k];
      const std::uint32_t mine = meet(spheres, box_of(b)).bits(),
                          theirs = mine == 0 ? 0 : meet(boxes_of_spheres(tree_.fields_of(b)), box).bits();
      const bool from_a = std::popcount(mine) <= std::popcount(theirs);
      const std::uint32_t node = from_a ? a : b, other = from_a ? b : a, lanes = from_a ? mine : theirs;
      if constexpr (Sink::listens)
        for_each_lane(there(node) & ~lanes,
                      [&](std::uint32_t p) { sink_.sphere_apart(tree_.index[node * group + p], other); });
      if (lanes == 0) continue;
      add_tests(node, lanes, other);
      if (tests_ > SphereQueues::test_limit) work_off();
    }
    q_.nodes_done += nodes_;
    nodes_ = 0;
  }

  HWY_INLINE void add_tests(std::uint32_t node, std::uint32_t lanes, std::uint32_t other) {
    const Bits bits;
    for (std::uint32_t k = 0; k < group; k += sphere_lanes) {
      const Kept<Bits> kept(lanes_of(bits, lanes >> k));
      store_side_by_side(bits, kept.compress(count_up(bits, node * group + k)), hn::Set(bits, other),
                         kept.size(), &q_.tests[tests_].place);
      tests_ += kept.size();
    }
  }

  HWY_NOINLINE void work_off() {
    for (std::size_t k = 0; k < tests_; ++k) test(q_.tests[k].place, q_.tests[k].node);
    q_.tests_done += tests_ * vectors;
    tests_ = 0;
  }

  /// The sphere at a place against those of a node.
  HWY_INLINE void test(std::uint32_t place, std::uint32_t node) {
    const float* const own = tree_.fields_of(place / group) + place % group;
    const Sphere sphere{own[0], own[group], own[2 * group], own[3 * group]};
    const std::uint32_t i = tree_.index[place];
    if constexpr (Sink::listens)
      for_each_lane(there(node), [&](std::uint32_t k) { sink_.compared(i, tree_.index[node * group + k]); });
    for (std::uint32_t k = 0; k < group; k += sphere_lanes)
      hits_.test(i, sphere, {tree_.fields_of(node) + k, group, tree_.index.data() + node * group + k});
  }

  const SphereTree& tree_;
  SphereQueues& q_;
  Found& found_;
  Sink& sink_;
  VectorHits<Found> hits_;
  std::size_t groups_ = 0, nodes_ = 0, tests_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
