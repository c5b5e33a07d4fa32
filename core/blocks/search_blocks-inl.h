// The pairs of a BlockTree: boxes of nodes against each other from the root down, then blocks against blocks, capsules
// one against sixteen, and eight spheres against eight.
#if defined(CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#undef CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#else
#define CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#endif

#include <bit>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/block_queues.h"
#include "catena/core/blocks/oriented_boxes-inl.h"
#include "catena/core/executor/pair_collector.h"
#include "hwy/cache_control.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// One search. Sink has the members of BlockEvidence; those of NoBlockEvidence cost nothing.
template <class Sink>
class BlockSearch {
 public:
  BlockSearch(const ChainView& chain, const BlockTree& tree, BlockQueues& queues, PairCollector::Lane& lane,
              Sink sink)
      : chain_(chain), tree_(tree), queues_(queues), lane_(lane), sink_(sink) {
    queues_.clear();
  }

  void run() {
    if (tree_.blocks == 0) return;
    along_the_chain();
    within(static_cast<std::uint32_t>(tree_.level.size()) - 1, 0);
    flush_rows();
    flush_pairs();
  }

 private:
  static constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block;

  /// Blocks against themselves, and against the next of their node along the chain, but for those that are ordered.
  void along_the_chain() {
    std::uint32_t before = 0;  // 1: the last window of the group before is ordered
    for (std::uint32_t g = 0; g * group < tree_.blocks; ++g) {
      const std::uint32_t begin = g * group, all = lanes(tree_.blocks_of(g));
      const bool in_chain = begin < tree_.chain_blocks;
      const std::uint32_t windows = in_chain ? tree_.ordered[g] : 0;
      const std::uint32_t inside = (windows | windows << 1 | before) & all, between = in_chain ? all >> 1 : 0;
      before = windows >> (group - 1);
      for_each(all & ~inside, [&](std::uint32_t k) { queues_.add_pair({begin + k, begin + k}); });
      for_each(between & ~windows, [&](std::uint32_t k) { queues_.add_pair({begin + k, begin + k + 1}); });
      if (Sink::listens || !adjacent_are_neighbours_) {
        for_each(inside, [&](std::uint32_t k) { ordered_inside(begin + k); });
        for_each(between & windows, [&](std::uint32_t k) { ordered_between(begin + k); });
      }
      if (queues_.pairs_full()) flush_pairs();
      if (lane_.satisfied()) return;
    }
  }

  /// Block b is ordered: of its spheres only those next to one another may collide, if they are not neighbours anyway.
  void ordered_inside(std::uint32_t b) {
    sink_.ordered_inside(b);
    for (std::uint32_t k = 0; k + 1 < block; ++k) adjacent(tree_.first[b] + k);
  }
  /// Of block b and the next only the last sphere and the first may collide.
  void ordered_between(std::uint32_t b) {
    sink_.ordered_between(b);
    adjacent(tree_.first[b] + block - 1);
  }
  void adjacent(std::uint32_t i) {
    if (!chain_.neighbours(i, i + 1) && Robust::overlap(chain_.spheres[i], chain_.spheres[i + 1]))
      lane_.collide(i, i + 1);
  }

  /// All pairs below box k of level l.
  void within(std::uint32_t l, std::uint32_t k) {
    if (lane_.satisfied()) return;
    if (l == 0) return within_node(k);
    const BlockTree::Level& children = tree_.level[l - 1];
    const std::uint32_t begin = k * group, count = std::min(group, children.count - begin);
    const float* const boxes = children.at(begin);
    const Boxes all = Boxes::load(boxes);
    for (std::uint32_t i = 0; i < count; ++i) {
      within(l - 1, begin + i);
      const std::uint32_t later = ((1u << count) - 1) & ~((2u << i) - 1);
      between_children(l - 1, begin + i, begin, meet(Boxes::all(boxes, i), all), later);
    }
  }

  /// All pairs of a block below box a of level l with one below b > a.
  void between(std::uint32_t l, std::uint32_t a, std::uint32_t b) {
    if (l == 0) return between_nodes(a, b);
    const BlockTree::Level &level = tree_.level[l], &children = tree_.level[l - 1];
    const std::uint32_t begin_a = a * group, begin_b = b * group;
    const std::uint32_t all_a = lanes(children.count - begin_a), all_b = lanes(children.count - begin_b);
    const float *const boxes_a = children.at(begin_a), *const boxes_b = children.at(begin_b);
    const Boxes of_b = Boxes::load(boxes_b);
    const std::uint32_t mine = meet(Boxes::load(boxes_a), Boxes::all(level.at(b), b % group)) & all_a;
    const std::uint32_t theirs = meet(of_b, Boxes::all(level.at(a), a % group)) & all_b;
    for_each(all_a & ~mine, [&](std::uint32_t i) { sink_.boxes_apart(l - 1, begin_a + i, l, b); });
    for_each(mine, [&](std::uint32_t i) {
      if (!lane_.satisfied())
        between_children(l - 1, begin_a + i, begin_b, meet(Boxes::all(boxes_a, i), of_b) & theirs, all_b);
    });
  }

  /// Box a of level l against those from b on, of which those in `candidates` count and those in `met` may meet it.
  void between_children(std::uint32_t l, std::uint32_t a, std::uint32_t b, std::uint32_t met, std::uint32_t candidates) {
    met &= candidates;
    for_each(candidates & ~met, [&](std::uint32_t j) { sink_.boxes_apart(l, a, l, b + j); });
    if (l == 0 && met != 0) {
      const std::uint32_t near = may_meet(OrientedBoxes::all(tree_.oriented_of(a), a % group), OrientedBoxes::load(tree_.oriented_of(b))) & met;
      for_each(met & ~near, [&](std::uint32_t j) { sink_.nodes_apart(a, b + j); });
      met = near;
    }
    for_each(met, [&](std::uint32_t j) { between(l, a, b + j); });
  }

  /// Blocks of one node against each other; those next to one another along the chain have met.
  void within_node(std::uint32_t k) {
    const std::uint32_t g = tree_.node_group[k], count = tree_.blocks_of(g), begin = g * group;
    const Intervals all = in_frame_of(k, Capsules::load(tree_.capsules_of(g)));
    const StoredIntervals single(all);
    const std::uint32_t skip = begin < tree_.chain_blocks ? 2 : 1;
    for (std::uint32_t i = 0; i + skip < count; ++i)
      row(begin + i, g, meet(single.all(i), all), lanes(count) & ~((1u << (i + skip)) - 1));
    make_room();
  }

  /// Blocks of node a against those of node b.
  void between_nodes(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ga = tree_.node_group[a], gb = tree_.node_group[b];
    const std::uint32_t all_a = lanes(tree_.blocks_of(ga)), all_b = lanes(tree_.blocks_of(gb));
    const Capsules of_a = Capsules::load(tree_.capsules_of(ga)), of_b = Capsules::load(tree_.capsules_of(gb));
    const Intervals b_by_a = in_frame_of(a, of_b);
    const std::uint32_t theirs = meet(b_by_a, own_intervals(a)) & all_b;
    for_each(all_b & ~theirs, [&](std::uint32_t j) { sink_.block_apart(gb * group + j, a); });
    if (theirs == 0) return;
    const std::uint32_t mine = meet(in_frame_of(b, of_a), own_intervals(b)) & all_a;
    if (Sink::listens)
      for_each(all_a & ~mine, [&](std::uint32_t i) { row(ga * group + i, gb, 0, theirs); });
    if (mine == 0) return;
    // An ordered window from the last block of one node to the first of the next.
    const bool ahead = gb == ga + 1 && window_leaves(ga), behind = ga == gb + 1 && window_leaves(gb);
    if (ahead && mine == 1u << (group - 1) && theirs == 1) return ordered_between(ga * group + group - 1);
    if (behind && mine == 1 && theirs == 1u << (group - 1)) return ordered_between(gb * group + group - 1);
    const StoredIntervals a_by_a(in_frame_of(a, of_a));
    for_each(mine, [&](std::uint32_t i) {
      std::uint32_t candidates = theirs;
      if (ahead && i == group - 1 && (theirs & 1)) {
        candidates &= ~1u;
        ordered_between(ga * group + i);
      } else if (behind && i == 0 && theirs >> (group - 1)) {
        candidates &= ~(1u << (group - 1));
        ordered_between(gb * group + group - 1);
      }
      row(ga * group + i, gb, meet(a_by_a.all(i), b_by_a), candidates);
    });
    make_room();
  }

  /// Whether the last block of group g and the next block are ordered.
  bool window_leaves(std::uint32_t g) const {
    return g * group < tree_.chain_blocks && tree_.ordered[g] >> (group - 1) != 0;
  }

  /// How far sixteen capsules reach along the axes of a node.
  HWY_INLINE Intervals in_frame_of(std::uint32_t node, const Capsules& capsules) const {
    const auto box = OrientedBoxes::all(tree_.oriented_of(node), node % group);
    return intervals(capsules, box.centre, box.axis);
  }
  HWY_INLINE Intervals own_intervals(std::uint32_t node) const {
    return intervals(OrientedBoxes::all(tree_.oriented_of(node), node % group).half);
  }

  /// Block a against those of group g in `candidates`, of which those in `met` may collide with it by their boxes.
  void row(std::uint32_t a, std::uint32_t g, std::uint32_t met, std::uint32_t candidates) {
    met &= candidates;
    for_each(candidates & ~met, [&](std::uint32_t j) { sink_.blocks_apart(a, g * group + j); });
    queues_.add_row({a, g, met});
  }

  void make_room() {
    if (!queues_.rows_full()) return;
    flush_rows();
  }

  void flush_rows() {
    for (const BlockQueues::Row& r : queues_.rows()) {
      const std::uint32_t a = r.block;
      const std::uint32_t near = may_collide(Capsules::all(tree_.capsules_of(a / group), a % group),
                                             Capsules::load(tree_.capsules_of(r.group))) & r.lanes;
      for_each(r.lanes & ~near, [&](std::uint32_t j) { sink_.blocks_apart(a, r.group * group + j); });
      for (std::uint32_t bits = near; bits != 0; bits &= bits - 1)
        queues_.add_pair({a, r.group * group + static_cast<std::uint32_t>(std::countr_zero(bits))});
      if (queues_.pairs_full()) flush_pairs();
    }
    queues_.clear_rows();
  }

  void flush_pairs() {
    const auto pairs = queues_.pairs();
    constexpr std::size_t ahead = 6;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (k + ahead < pairs.size()) {
        for (const std::uint32_t b : {pairs[k + ahead].i, pairs[k + ahead].j}) {
          const Sphere* const s = tree_.spheres(chain_, b);
          hwy::Prefetch(s), hwy::Prefetch(s + 4);
        }
      }
      leaves(pairs[k].i, pairs[k].j);
    }
    queues_.clear_pairs();
  }

  /// Spheres of block a against those of block b; of a block with itself, each pair once.
  void leaves(std::uint32_t a, std::uint32_t b) {
    const Sphere *const sa = tree_.spheres(chain_, a), *const sb = tree_.spheres(chain_, b);
    SpherePairs pairs = sphere_pairs(sa, sb);
    constexpr std::uint64_t later = 0x0080C0E0F0F8FCFEu;  // bit 8 i + j where j > i
    std::uint64_t wanted = a == b ? later : ~std::uint64_t{0};
    if constexpr (Sink::listens) account(a, b, wanted);
    wanted &= pairs.may;
    for (; wanted != 0; wanted &= wanted - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(wanted));
      std::uint32_t i = tree_.index(a, bit / block), j = tree_.index(b, bit % block);
      if (i == BlockTree::no_sphere || j == BlockTree::no_sphere) continue;
      if (i > j) std::swap(i, j);
      if (chain_.neighbours(i, j)) continue;
      if ((pairs.certain >> bit & 1) || Robust::overlap(sa[bit / block], sb[bit % block])) lane_.collide(i, j);
    }
  }

  /// Tells the sink of every pair that is compared.
  void account(std::uint32_t a, std::uint32_t b, std::uint64_t wanted) {
    for (; wanted != 0; wanted &= wanted - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(wanted));
      const std::uint32_t i = tree_.index(a, bit / block), j = tree_.index(b, bit % block);
      if (i == BlockTree::no_sphere || j == BlockTree::no_sphere) continue;
      sink_.compared(std::min(i, j), std::max(i, j));
    }
  }

  static std::uint32_t lanes(std::uint32_t count) { return count >= group ? 0xFFFFu : (1u << count) - 1; }

  template <class Body>
  static HWY_INLINE void for_each(std::uint32_t bits, const Body& body) {
    for (; bits != 0; bits &= bits - 1) body(static_cast<std::uint32_t>(std::countr_zero(bits)));
  }

  const ChainView& chain_;
  const BlockTree& tree_;
  BlockQueues& queues_;
  PairCollector::Lane& lane_;
  Sink sink_;
  /// An ordered window is of one strand, where an index window of 1 or more takes in the next sphere.
  const bool adjacent_are_neighbours_ = chain_.exclusion.rule == Exclusion::Rule::index_window;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
