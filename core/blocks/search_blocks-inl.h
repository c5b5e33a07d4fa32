// The colliding pairs of a BlockTree: nodes that may meet, then their blocks, capsules one against sixteen,
// and eight spheres against eight.
#if defined(CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#undef CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#else
#define CATENA_CORE_BLOCKS_SEARCH_BLOCKS_INL_H
#endif

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/block_queues.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/blocks/node_walk-inl.h"
#include "catena/core/blocks/tests-inl.h"
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

  /// Every pair of the tree.
  void run() {
    if (tree_.blocks == 0) return;
    const std::uint32_t nodes = tree_.level[0].count;
    along_the_chain(0, nodes, [](std::uint32_t) { return true; });
    for (std::uint32_t k = 0; k < nodes && !stop(); ++k) within(k);
    NodeWalk(tree_, *this, sink_).run();
    finish();
  }

  /// Every pair within nodes begin to end - 1, and from the last block of each to the next along the chain,
  /// but those within a crowded node.
  void run_nodes(const Crowding& crowding, std::uint32_t begin, std::uint32_t end) {
    along_the_chain(begin, end, [&](std::uint32_t k) { return !crowding.crowded(k); });
    for (std::uint32_t k = begin; k < end && !stop(); ++k)
      if (!crowding.crowded(k)) within(k);
    finish();
  }

  /// Every pair of these nodes, but of two crowded ones.
  void run_pairs(const Crowding& crowding, std::span<const Pair> nodes) {
    for (const Pair& pair : nodes)
      if (!crowding.left_out(pair) && !stop()) met(pair.i, pair.j);
    finish();
  }

  // What NodeWalk asks for.
  void met(std::uint32_t a, std::uint32_t b) { between(a, b); }
  bool left_out(std::size_t, std::uint32_t, std::uint32_t) const { return false; }
  bool left_out_group(std::size_t, std::uint32_t, std::uint32_t) const { return false; }
  bool stop() const { return lane_.satisfied(); }

 private:
  static constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block;

  /// Of nodes `from` to `to` - 1 that are wanted: blocks against themselves, and against the next of their
  /// node along the chain, but for those that are ordered.
  template <class Wanted>
  void along_the_chain(std::uint32_t from, std::uint32_t to, const Wanted& wanted) {
    // 1: the last window of the group before is ordered.
    std::uint32_t before = from > 0 ? tree_.ordered[from - 1] >> (group - 1) : 0u;
    for (std::uint32_t g = from; g < to; ++g) {
      const std::uint32_t begin = g * group, all = lane_bits(tree_.blocks_of(g));
      const std::uint32_t windows = tree_.ordered[g], between = all >> 1;
      const std::uint32_t inside = (windows | windows << 1 | before) & all;
      before = windows >> (group - 1);
      if (!wanted(g)) continue;
      for_each_lane(all & ~inside, [&](std::uint32_t k) { queues_.add_pair({begin + k, begin + k}); });
      for_each_lane(between & ~windows, [&](std::uint32_t k) {
        queues_.add_pair({begin + k, begin + k + 1});
      });
      if (Sink::listens || !adjacent_are_neighbours_) {
        for_each_lane(inside, [&](std::uint32_t k) { ordered_inside(begin + k); });
        for_each_lane(between & windows, [&](std::uint32_t k) { ordered_between(begin + k); });
      }
      if (queues_.pairs_full()) flush_pairs();
      if (lane_.satisfied()) return;
    }
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
    const Intervals reach = in_frame_of(tree_, 0, k, 0, k);
    if (!Sink::listens && in_a_row(reach, count)) return;
    const StoredIntervals single(reach);
    for (std::uint32_t i = 0; i + skip < count; ++i)
      row(begin + i, k, meet(single.all(i), reach), lane_bits(count) & ~((1u << (i + skip)) - 1));
    make_room();
  }

  /// Blocks of node a against those of node b > a.
  void between(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t all_a = lane_bits(tree_.blocks_of(a)), all_b = lane_bits(tree_.blocks_of(b));
    const Intervals b_by_a = in_frame_of(tree_, 0, a, 0, b);
    const std::uint32_t theirs = meet(b_by_a, own_intervals(tree_, 0, a)) & all_b;
    for_each_lane(all_b & ~theirs, [&](std::uint32_t j) { sink_.child_apart(0, b * group + j, a); });
    if (theirs == 0) return;
    const std::uint32_t mine = meet(in_frame_of(tree_, 0, b, 0, a), own_intervals(tree_, 0, b)) & all_a;
    if (Sink::listens)
      for_each_lane(all_a & ~mine, [&](std::uint32_t i) { row(a * group + i, b, 0, theirs); });
    if (mine == 0) return;
    // An ordered window from the last block of one node to the first of the next.
    const bool ahead = b == a + 1 && tree_.ordered[a] >> (group - 1) != 0;
    if (ahead && mine == 1u << (group - 1) && theirs == 1) return ordered_between(a * group + group - 1);
    const StoredIntervals a_by_a(in_frame_of(tree_, 0, a, 0, a));
    for_each_lane(mine, [&](std::uint32_t i) {
      std::uint32_t candidates = theirs;
      if (ahead && i == group - 1 && (theirs & 1)) {
        candidates &= ~1u;
        ordered_between(a * group + i);
      }
      row(a * group + i, b, meet(a_by_a.all(i), b_by_a), candidates);
    });
    make_room();
  }

  /// Block a against those of group g in `candidates`, of which those in `met` may collide with it by their
  /// boxes.
  void row(std::uint32_t a, std::uint32_t g, std::uint32_t met, std::uint32_t candidates) {
    met &= candidates;
    for_each_lane(candidates & ~met, [&](std::uint32_t j) { sink_.blocks_apart(a, g * group + j); });
    queues_.add_row({a, g, met});
  }

  void make_room() {
    if (queues_.rows_full()) flush_rows();
  }
  void finish() {
    flush_rows();
    flush_pairs();
  }

  void flush_rows() {
    for (const BlockQueues::Row& r : queues_.rows()) {
      const std::uint32_t a = r.block;
      const std::uint32_t near = may_collide(Capsules::all(tree_.capsules_of(a / group), a % group),
                                             Capsules::load(tree_.capsules_of(r.group))) &
                                 r.lanes;
      for_each_lane(r.lanes & ~near, [&](std::uint32_t j) { sink_.blocks_apart(a, r.group * group + j); });
      for_each_lane(near, [&](std::uint32_t j) {
        sink_.blocks_near(a, r.group * group + j);
        queues_.add_pair({a, r.group * group + j});
      });
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
    const SpherePairs pairs = sphere_pairs(sa, sb);
    constexpr std::uint64_t later = 0x0080C0E0F0F8FCFEu;  // bit 8 i + j where j > i
    std::uint64_t wanted = a == b ? later : ~std::uint64_t{0};
    if constexpr (Sink::listens) account(a, b, wanted);
    wanted &= pairs.may;
    for (; wanted != 0; wanted &= wanted - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(wanted));
      std::uint32_t i = tree_.index(a, bit / block), j = tree_.index(b, bit % block);
      if (i == BlockTree::no_sphere || j == BlockTree::no_sphere) continue;
      if (i > j) std::swap(i, j);
      if (window_is_all_ ? j - i <= chain_.exclusion.window : chain_.neighbours(i, j)) continue;
      if ((pairs.certain >> bit & 1) || Robust::overlap(sa[bit / block], sb[bit % block]))
        lane_.collide(i, j);
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

  const ChainView& chain_;
  const BlockTree& tree_;
  BlockQueues& queues_;
  PairCollector::Lane& lane_;
  Sink sink_;
  /// Only the index window makes neighbours.
  const bool window_is_all_ = chain_.exclusion.one_open_strand && chain_.exclusion.extra_row == nullptr &&
                              chain_.exclusion.rule == Exclusion::Rule::index_window;
  /// An ordered window is of one strand, where an index window of 1 or more takes in the next sphere.
  const bool adjacent_are_neighbours_ = chain_.exclusion.rule == Exclusion::Rule::index_window;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
