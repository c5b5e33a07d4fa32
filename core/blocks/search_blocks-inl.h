// The colliding pairs of a BlockTree: nodes that may meet, then their blocks, capsules one against sixteen,
// and eight spheres against eight.
#if defined(CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#undef CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#else
#define CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#endif

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/leaf_pairs-inl.h"
#include "catena/core/blocks/neighbour_blocks.h"
#include "catena/core/blocks/node_walk-inl.h"

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

  /// Every pair of the tree.
  void run() {
    if (tree_.blocks == 0) return;
    const std::uint32_t nodes = tree_.level[0].count;
    along_the_chain(0, nodes, [](std::uint32_t) { return 0u; });
    for (std::uint32_t k = 0; k < nodes && !stop(); ++k) {
      within(k);
      if (tree_.with_the_next(0, k)) in_a_row_to_the_next(k);
    }
    NodeWalk(tree_, *this, sink_).run();
    finish();
  }

  /// Every pair within nodes begin to end - 1, and from the last block of each to the next along the chain,
  /// but those within a crowded node. To be finished.
  void run_nodes(const Crowding& crowding, std::uint32_t begin, std::uint32_t end) {
    along_the_chain(begin, end, [&](std::uint32_t k) { return crowding.dense(k); });
    for (std::uint32_t k = begin; k < end && !stop(); ++k) {
      if (!crowding.some() || !crowding.crowded(k)) within(k);
      if (k + 1 < crowding.nodes() && crowding.left_out({k, k + 1}))
        to_the_next(k, crowding.dense(k), crowding.dense(k + 1));
      else if (tree_.with_the_next(0, k))
        in_a_row_to_the_next(k);
    }
  }

  /// Every pair of these nodes, but of two crowded ones. To be finished.
  void run_pairs(const Crowding& crowding, std::span<const Pair> nodes) {
    for (const Pair& pair : nodes)
      if (!crowding.left_out(pair) && !stop()) met(pair.i, pair.j);
  }

  void finish() {
    flush_rows();
    leaves_.flush();
  }

  // What NodeWalk asks for.
  void met(std::uint32_t a, std::uint32_t b) { between(a, b); }
  bool left_out(std::size_t, std::uint32_t, std::uint32_t) const { return false; }
  bool left_out_group(std::size_t, std::uint32_t, std::uint32_t) const { return false; }
  bool stop() const { return lane_.satisfied(); }

 private:
  static constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block;

  /// Of nodes `from` to `to` - 1: blocks against themselves, and against the next of their node along the
  /// chain, but for those that are ordered. dense(node) has bits of blocks that are left out, against
  /// themselves and one another.
  template <class Dense>
  void along_the_chain(std::uint32_t from, std::uint32_t to, const Dense& dense) {
    // 1: the last window of the group before is ordered.
    std::uint32_t before = from > 0 ? tree_.ordered[from - 1] >> (group - 1) : 0u;
    for (std::uint32_t g = from; g < to; ++g) {
      const std::uint32_t begin = g * group, blocks = lane_bits(tree_.blocks_of(g)), left_out = dense(g);
      const std::uint32_t all = blocks & ~left_out, between = blocks >> 1 & ~(left_out & left_out >> 1);
      const std::uint32_t windows = tree_.ordered[g];
      const std::uint32_t inside = (windows | windows << 1 | before) & all;
      before = windows >> (group - 1);
      const BlockRun::Asked asked = but_neighbours(begin, {all & ~inside, between & ~windows}),
                            rest = leaves_.look_along(begin, asked);
      for_each_lane(rest.inside, [&](std::uint32_t k) { leaves_.add(begin + k, begin + k); });
      for_each_lane(rest.onward, [&](std::uint32_t k) { leaves_.add(begin + k, begin + k + 1); });
      if (Sink::listens || !adjacent_are_neighbours_) {
        for_each_lane(inside, [&](std::uint32_t k) { ordered_inside(begin + k); });
        for_each_lane(between & windows, [&](std::uint32_t k) { ordered_between(begin + k); });
      }
      leaves_.make_room();
      if (lane_.satisfied()) return;
    }
  }

  /// The last block of a node and the first of the next, unless both are dense, where no other pair of the
  /// two is to be met: they are in a row, or others meet what is crowded.
  void to_the_next(std::uint32_t node, std::uint32_t dense, std::uint32_t dense_next) {
    const std::uint32_t last = node * group + group - 1;
    if ((dense >> (group - 1) & dense_next & 1) != 0) return;
    if (tree_.ordered[node] >> (group - 1)) return ordered_between(last);
    if (!left_to_neighbours(last, last + 1)) leaves_.add(last, last + 1);
    leaves_.make_room();
  }

  void in_a_row_to_the_next(std::uint32_t node) {
    sink_.with_the_next(0, node);
    to_the_next(node, 0, 0);
  }

  /// Blocks a <= b have nothing but neighbours, and nobody listens.
  bool left_to_neighbours(std::uint32_t a, std::uint32_t b) const {
    return !Sink::listens && neighbours_.all(a, b);
  }
  BlockRun::Asked but_neighbours(std::uint32_t begin, BlockRun::Asked asked) const {
    if (Sink::listens || !neighbours_.some()) return asked;
    for_each_lane(asked.inside, [&](std::uint32_t k) {
      if (neighbours_.all(begin + k, begin + k)) asked.inside &= ~(1u << k);
    });
    for_each_lane(asked.onward, [&](std::uint32_t k) {
      if (neighbours_.all(begin + k, begin + k + 1)) asked.onward &= ~(1u << k);
    });
    return asked;
  }

  /// Block b is ordered: of its spheres only those next to one another may collide, if they are not
  /// neighbours anyway.
  void ordered_inside(std::uint32_t b) {
    sink_.ordered_inside(b);
    if (adjacent_are_neighbours_) return;
    for (std::uint32_t k = 0; k + 1 < block; ++k) adjacent(tree_.first[b] + k);
  }
  /// Of block b and the next only the last sphere and the first may collide.
  void ordered_between(std::uint32_t b) {
    sink_.ordered_between(b);
    if (!adjacent_are_neighbours_) adjacent(tree_.first[b] + block - 1);
  }
  void adjacent(std::uint32_t i) {
    if (!chain_.neighbours(i, i + 1) && Robust::overlap(chain_.spheres[i], chain_.spheres[i + 1]))
      lane_.collide(i, i + 1);
  }

  /// Blocks of one node against each other, but for those that along_the_chain met.
  void within(std::uint32_t k) {
    constexpr std::uint32_t skip = 2;  // a block itself and the next
    const std::uint32_t begin = k * group, count = tree_.blocks_of(k);
    if (tree_.in_a_row(0, k)) return sink_.in_a_row(0, k);
    if (left_to_neighbours(begin, begin + count - 1)) return;
    Intervals reach = in_frame_of(tree_, 0, k, 0, k);
    const StoredIntervals single(reach);
    for (std::uint32_t i = 0; i + skip < count; ++i)
      row(begin + i, k, meet(single.all(i), reach), lane_bits(count) & ~((1u << (i + skip)) - 1), true);
    make_room();
  }

  /// Blocks of node a against those of node b > a.
  void between(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t all_a = lane_bits(tree_.blocks_of(a)), all_b = lane_bits(tree_.blocks_of(b));
    const bool beside = !Sink::listens && neighbours_.all(a * group + group - 1, b * group);
    if (beside && neighbours_.all(a * group, b * group + tree_.blocks_of(b) - 1)) return;
    Intervals b_by_a = in_frame_of(tree_, 0, a, 0, b);
    const std::uint32_t theirs = meet(b_by_a, tree_, 0, a) & all_b;
    for_each_lane(all_b & ~theirs, [&](std::uint32_t j) { sink_.child_apart(0, b * group + j, a); });
    if (theirs == 0) return;
    std::uint32_t mine = meet(in_frame_of(tree_, 0, b, 0, a), tree_, 0, b) & all_a;
    if (Sink::listens)
      for_each_lane(all_a & ~mine, [&](std::uint32_t i) { row(a * group + i, b, 0, theirs, false); });
    if (mine == 0) return;
    // An ordered window from the last block of one node to the first of the next.
    const bool ahead = b == a + 1 && tree_.ordered[a] >> (group - 1) != 0;
    if (ahead && mine == 1u << (group - 1) && theirs == 1) return ordered_between(a * group + group - 1);
    const StoredIntervals& a_by_a = own_intervals_of(a);
    // Not for_each_lane: GCC calls its body then, as it is long, and with AVX2 that takes a sixth longer.
    for (; mine != 0; mine &= mine - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(mine));
      std::uint32_t candidates = theirs;
      if (ahead && i == group - 1 && (theirs & 1)) {
        candidates &= ~1u;
        ordered_between(a * group + i);
      }
      row(a * group + i, b, meet(a_by_a.all(i), b_by_a), candidates, beside);
    }
    make_room();
  }

  /// Those of the blocks of node a along its own axes, kept for the next node that meets it.
  const StoredIntervals& own_intervals_of(std::uint32_t a) {
    if (a != kept_of_) {
      kept_ = StoredIntervals(in_frame_of(tree_, 0, a, 0, a));
      kept_of_ = a;
    }
    return kept_;
  }

  /// Block a against those of group g in `candidates`, of which those in `met` may collide with it by their
  /// boxes. Where they are `beside` it along the chain, some may have nothing but its neighbours.
  HWY_INLINE void row(std::uint32_t a, std::uint32_t g, std::uint32_t met, std::uint32_t candidates,
                      bool beside) {
    met &= candidates;
    for_each_lane(candidates & ~met, [&](std::uint32_t j) { sink_.blocks_apart(a, g * group + j); });
    if (!Sink::listens && beside && neighbours_.some()) met &= ~neighbours_.lanes(a, g);
    queues_.add_row({a, g, met});
  }

  void make_room() {
    if (queues_.rows_full()) flush_rows();
  }
  void flush_rows() {
    const std::span<const BlockQueues::Row> rows = queues_.rows();
    if constexpr (Lanes16::parts > 1) {
      for (const BlockQueues::Row& r : rows) told(r, may_collide(of_row(r), of_group(r), r.lanes));
    } else {
      std::size_t k = 0;
      for (; k + 1 < rows.size(); k += 2) {
        const BlockQueues::Row &r = rows[k], &s = rows[k + 1];
        const std::uint32_t near =
            may_collide(side_by_side(of_row(r), of_row(s)), side_by_side(of_group(r), of_group(s)));
        told(r, near & 0xFFFF), told(s, near >> group);
      }
      if (k < rows.size()) told(rows[k], may_collide(of_row(rows[k]), of_group(rows[k])));
    }
    queues_.clear_rows();
  }
  CapsulesOf<16> of_row(const BlockQueues::Row& r) const {
    return Capsules::all(tree_.capsules_of(r.block / group), r.block % group);
  }
  CapsulesOf<16> of_group(const BlockQueues::Row& r) const {
    return Capsules::load(tree_.capsules_of(r.group));
  }
  /// Of a row's lanes those whose capsules may collide.
  void told(const BlockQueues::Row& r, std::uint32_t may) {
    const std::uint32_t near = may & r.lanes;
    for_each_lane(r.lanes & ~near,
                  [&](std::uint32_t j) { sink_.blocks_apart(r.block, r.group * group + j); });
    if constexpr (Sink::listens)
      for_each_lane(near, [&](std::uint32_t j) { sink_.blocks_near(r.block, r.group * group + j); });
    leaves_.add(r.block, r.group * group, near);
    leaves_.make_room();
  }

  const ChainView& chain_;
  const BlockTree& tree_;
  BlockQueues& queues_;
  PairCollector::Lane& lane_;
  const Sink sink_;
  LeafPairs<Sink> leaves_{chain_, tree_, queues_, lane_, sink_};
  const NeighbourBlocks neighbours_{chain_, tree_};
  std::uint32_t kept_of_ = ~0u;
  StoredIntervals kept_;
  /// An ordered window is of one strand, where an index window of 1 or more takes in the next sphere.
  const bool adjacent_are_neighbours_ = chain_.exclusion.rule == Exclusion::Rule::index_window;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
