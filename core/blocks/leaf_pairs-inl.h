// Eight spheres against eight, or many times so along the chain: the last step of a search for the pairs of a
// BlockTree.
#if defined(CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H
#undef CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H
#else
#define CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H
#endif

#include <algorithm>
#include <span>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/blocks/block_queues.h"
#include "catena/core/blocks/block_run-inl.h"
#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/consecutive_blocks-inl.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/met_tiles-inl.h"
#include "catena/core/blocks/open_pairs-inl.h"
#include "catena/core/blocks/own_units-inl.h"
#include "catena/core/blocks/sphere_tiles-inl.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/blocks/tile_counts-inl.h"
#include "catena/core/blocks/window_filter.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/prefetch.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Pairs of blocks that may collide, of which the colliding spheres are reported. Sink as for BlockSearch.
template <class Sink>
class LeafPairs {
 public:
  LeafPairs(const ChainView& chain, const BlockTree& tree, BlockQueues& queues, PairCollector::Lane& lane,
            const Sink& sink)
      : chain_(chain), tree_(tree), queues_(queues), lane_(lane), sink_(sink) {}

  /// Blocks a <= b, to be looked into; room for those of a node along the chain, or of a row, then call
  /// make_room.
  void add(std::uint32_t a, std::uint32_t b) { queues_.add_pair({a, b}); }
  /// Block a and each of sixteen from b on whose bit is set.
  HWY_INLINE void add(std::uint32_t a, std::uint32_t b, std::uint32_t lanes) {
    const hn::CappedTag<std::uint32_t, 16> bits;
    for (std::uint32_t k = 0; k < BlockTree::group; k += hn::MaxLanes(bits))
      queues_.add_pairs(
          store_pairs(bits, a, count_up(bits, b + k), lanes_of(bits, lanes >> k), queues_.next_pairs()));
  }
  void make_room() {
    if (queues_.pairs_full()) flush();
  }

  /// Looks into those of the node's blocks from `begin` on that are asked for and follow one another without
  /// a gap, if there are enough of them to do so at once; the rest is to be added.
  HWY_INLINE BlockRun::Asked look_along(std::uint32_t begin, const BlockRun::Asked& asked) {
    constexpr std::uint32_t enough = 10;
    if (asked.pairs() < enough) return asked;
    const BlockRun::Asked run = asked & without_gap(begin);
    if (run.pairs() < enough) return asked;
    look_at_run(begin, run);
    return asked - run;
  }

  void flush() {
    if (HWY_UNLIKELY(own_units_.some()))
      compare_queued<true>();
    else
      compare_queued<false>();
    queues_.clear_pairs();
    decide();
    hand_over();
  }

 private:
  static constexpr std::uint32_t block = BlockTree::block;
  static constexpr std::size_t many = 4;  ///< spheres of two blocks that overlap, on average

  template <bool in_own_units>
  HWY_INLINE void compare_queued() {
    const auto pairs = queues_.pairs();
    MetTiles met;
    Sphere copies[in_own_units ? MetTiles::most : 1][2 * block];
    for (std::size_t begin = 0; begin < pairs.size(); begin += MetTiles::most) {
      const auto some = pairs.subspan(begin, std::min<std::size_t>(MetTiles::most, pairs.size() - begin));
      Comparison comparison[MetTiles::most];
      for (std::size_t k = 0; k < some.size(); ++k) {
        comparison[k] = prepare(some[k].i, some[k].j, met);
        if constexpr (in_own_units)
          own_units_.change(some[k], comparison[k].rows, comparison[k].columns, copies[k]);
      }
      for (std::uint32_t k = 0; k < met.size(); ++k) met.say(k, comparison[k].verdict(slack_));
      tell(met);
      met.clear();
    }
  }

  /// Keeps the pairs that overlap, and those that are decided later.
  HWY_INLINE void tell(const MetTiles& met) {
    if (HWY_UNLIKELY(many_overlap_))
      tell_many(met);
    else
      tell_overlaps(met);
    if (HWY_LIKELY(!met.any_open())) return;
    for (std::uint32_t k = 0; k < met.size(); k += MetTiles::at_once)
      met.for_open(k, [&](const MetTiles::Eight& eight) HWY_ATTR {
        open_.add(eight);
        if (open_.full()) decide();
      });
  }

  HWY_INLINE void tell_overlaps(const MetTiles& met) {
    std::size_t found = 0;
    for (std::uint32_t k = 0; k < met.size(); k += MetTiles::at_once) {
      Pair *const from = hits_ + hit_count_, *to = from;
      met.for_overlap(k, [&](const MetTiles::Eight& eight) HWY_ATTR { to = store_pairs(eight, to); });
      found += static_cast<std::size_t>(to - from);
      hit_count_ = static_cast<std::size_t>(to - hits_);
      if (HWY_UNLIKELY(hit_count_ > BlockQueues::hit_limit)) hand_over();
    }
    many_overlap_ = counts_ != nullptr && found >= many * met.size();
  }
  /// The same where many did before: their collisions are counted block by block, which is quicker then.
  HWY_NOINLINE void tell_many(const MetTiles& met) {
    hand_over();
    count_blocks(met);
    counted_ = true;
    tell_overlaps(met);
    hand_over();
    counted_ = false;
  }
  void count_blocks(const MetTiles& met) const {
    for (std::uint32_t k = 0; k < met.size(); ++k) {
      if (met.overlap(k) == 0) continue;
      const auto [row, column] = met.corner(k);
      if (std::max(row, column) + block <= chain_.size) {
        count_up_tile(met.overlap(k), counts_ + row, counts_ + column);
        continue;
      }
      for (std::uint64_t left = met.overlap(k); left != 0; left &= left - 1) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(left));
        ++counts_[row + SphereTiles::row_of(bit)], ++counts_[column + SphereTiles::column_of(bit)];
      }
    }
  }

  /// Eight spheres against eight, of which those `asked` count.
  struct Comparison {
    const Sphere *rows, *columns;
    std::uint64_t asked;
    HWY_INLINE SphereTiles::Verdict verdict(float slack) const {
      SphereTiles::Verdict all = SphereTiles(columns).compare(rows, slack);
      all.keep(asked);
      return all;
    }
  };
  /// Of blocks a and b: what there is to ask of them, and nothing that takes a vector, as registers for both
  /// are few.
  HWY_INLINE Comparison prepare(std::uint32_t a, std::uint32_t b, MetTiles& met) {
    const std::uint32_t row = tree_.begin_of(a), column = tree_.begin_of(b);
    Comparison result{spheres_ + row, spheres_ + column, later_than(last_within(row, column))};
    if (HWY_UNLIKELY(((tree_.first[a] | tree_.first[b]) & BlockTree::unfilled) != 0)) {
      result.rows = tree_.spheres(chain_, a), result.columns = tree_.spheres(chain_, b);
      result.asked &= within_first(tree_.size_of(a), tree_.size_of(b));
    }
    for (const Sphere* const s : {result.rows, result.columns}) prefetch(s), prefetch(s + 4);
    if constexpr (Sink::listens) account(a, b);
    met.add(row, column);
    return result;
  }

  /// Of spheres `row` + p and `column` + q of two blocks those are looked at for which q - p is greater than
  /// this: no nearer ones on a strand may collide. Those of one block are met once.
  HWY_INLINE std::int32_t last_within(std::uint32_t row, std::uint32_t column) const {
    constexpr std::int32_t most = block;
    const ExclusionView& rule = chain_.exclusion;
    const std::uint32_t left = beside_ - std::min(column - row, beside_);
    if (!rule.one_open_strand && left > 0 && rule.strand_of[row] != rule.strand_of[column]) return -most;
    return static_cast<std::int32_t>(std::min(left, 2 * block)) - most;
  }

  /// Of a node's blocks those that are filled; and of these, which are followed by one that is, on the same
  /// strand. There the difference of two spheres' places is that of their numbers.
  BlockRun::Asked without_gap(std::uint32_t begin) const {
    const std::uint32_t count = tree_.blocks_of(begin / BlockRun::blocks), all = lane_bits(count);
    const std::uint32_t* const first = tree_.first.data() + begin;
    const ExclusionView& rule = chain_.exclusion;
    const auto joined = [&](std::uint32_t a, std::uint32_t b) {
      return first[b] == first[a] + (b - a) * block &&
             (rule.one_open_strand || rule.strand_of[first[a]] == rule.strand_of[first[b]]);
    };
    const auto filled = [&](std::uint32_t k) { return (first[k] & BlockTree::unfilled) == 0; };
    // One that is unfilled on the way would bring the last nearer.
    if (filled(0) && joined(0, count - 1)) return {all, all >> 1};
    BlockRun::Asked result{0, 0};
    for (std::uint32_t k = 0; k < count; ++k) {
      if (!filled(k)) continue;
      result.inside |= 1u << k;
      if (k + 1 < count && joined(k, k + 1)) result.onward |= 1u << k;
    }
    return result;
  }

  /// What is asked for without a gap.
  HWY_NOINLINE void look_at_run(std::uint32_t begin, const BlockRun::Asked& asked) {
    if constexpr (Sink::listens) {
      for_each_lane(asked.inside, [&](std::uint32_t k) { account(begin + k, begin + k); });
      for_each_lane(asked.onward, [&](std::uint32_t k) { account(begin + k, begin + k + 1); });
    }
    Sphere copy[(BlockRun::blocks + 1) * block];
    const Sphere* spheres = consecutive_blocks(chain_, tree_, begin / BlockRun::blocks, copy);
    if (HWY_UNLIKELY(own_units_.some())) spheres = own_units_.changed(begin, spheres, copy);
    const BlockRun run(spheres, asked, window_, slack_);
    std::uint32_t first[BlockRun::blocks];
    for (std::uint32_t k = 0; k < BlockRun::blocks; ++k)
      first[k] = tree_.begin_of(std::min(begin + k, tree_.blocks - 1));
    const hn::CappedTag<std::uint32_t, 16> bits;
    constexpr std::uint32_t lanes = hn::MaxLanes(bits);
    const auto for_each_vector = [&](std::uint32_t i, std::uint32_t j, std::uint32_t blocks,
                                     const auto& body) HWY_ATTR {
      for (std::uint32_t k = 0; k < BlockRun::blocks; k += lanes) {
        const auto of_block = hn::LoadU(bits, first + k);
        body(hn::Add(of_block, hn::Set(bits, i)), hn::Add(of_block, hn::Set(bits, j)),
             lanes_of(bits, blocks >> k));
      }
    };
    RunCounts counts;
    const bool count = many_along_;
    if (count) hand_over(), counts.clear(), counted_ = true;
    std::size_t found = 0;
    run.for_overlap([&](std::uint32_t i, std::uint32_t j, std::uint32_t blocks) HWY_ATTR {
      for_each_vector(i, j, blocks, [&](const auto& a, const auto& b, const auto& keep) HWY_ATTR {
        hit_count_ += store_pairs(bits, a, b, keep, hits_ + hit_count_);
      });
      if (count) counts.add(i, j, blocks);
      found += static_cast<std::size_t>(std::popcount(blocks));
      if (HWY_UNLIKELY(hit_count_ > BlockQueues::hit_limit)) hand_over();
    });
    if (count) {
      counts.add_to(counts_, first, asked.inside | asked.onward | asked.onward << 1);
      hand_over();
      counted_ = false;
    }
    many_along_ = counts_ != nullptr && found >= many * asked.pairs();
    if (lane_.any_will_do() && found > 0) hand_over();
    queues_.add_looked(asked.pairs());
    if (HWY_LIKELY(!run.any_open())) return;
    run.for_open([&](std::uint32_t i, std::uint32_t j, std::uint32_t blocks) HWY_ATTR {
      for_each_vector(i, j, blocks, [&](const auto& a, const auto& b, const auto& keep) HWY_ATTR {
        open_.add(bits, a, b, keep);
        if (open_.full()) decide();
      });
    });
  }

  HWY_NOINLINE void decide() {
    queues_.add_open(open_.size());
    report(open_.decide());
  }
  void hand_over() {
    if (counted_)
      lane_.counted({hits_, hit_count_});
    else
      report({hits_, hit_count_});
    hit_count_ = 0;
  }
  void report(std::span<Pair> hits) {
    lane_.collide(std::span<const Pair>(window_is_all_ ? hits : filter_.without_neighbours(hits)));
  }

  /// Tells the sink of every pair that is compared.
  void account(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t size_a = tree_.size_of(a), size_b = tree_.size_of(b);
    for (std::uint32_t p = 0; p < size_a; ++p)
      for (std::uint32_t q = a == b ? p + 1 : 0; q < size_b; ++q)
        sink_.compared(tree_.index(a, p), tree_.index(b, q));
  }

  const ChainView& chain_;
  const WindowFilter filter_{chain_};
  const BlockTree& tree_;
  const Sphere* const spheres_ = tree_.spheres(chain_);
  BlockQueues& queues_;
  PairCollector::Lane& lane_;
  const Sink& sink_;
  /// The index window alone makes neighbours, of one strand; else it is not asked before the rest is known.
  const bool window_is_all_ = chain_.exclusion.window_alone;
  /// Within it spheres of a strand are neighbours, whatever else makes some.
  const std::uint32_t window_ = chain_.reach.certain;
  /// Blocks whose first spheres are farther apart have none within it.
  const std::uint32_t beside_ = std::min(window_, ~std::uint32_t{0} - block) + block;
  const float slack_ = Robust::binary32_slack * tree_.doubt;
  const OwnUnits own_units_{chain_, tree_};
  OpenPairs open_{chain_};
  Pair* const hits_ = queues_.hits();
  std::size_t hit_count_ = 0;
  /// The lane's, where no pair that is found is a neighbour's.
  std::uint32_t* const counts_ = window_is_all_ ? lane_.counts() : nullptr;
  bool counted_ = false;       ///< the hits are
  bool many_overlap_ = false;  ///< of the blocks before
  bool many_along_ = false;    ///< of those before along the chain
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
