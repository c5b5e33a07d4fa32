// Eight spheres against eight: the last step of a search for the pairs of a BlockTree.
#if defined(CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H
#undef CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H
#else
#define CATENA_CORE_BLOCKS_LEAF_PAIRS_INL_H
#endif

#include <algorithm>
#include <span>

#include "catena/core/blocks/block_queues.h"
#include "catena/core/blocks/count_up-inl.h"
#include "catena/core/blocks/open_pairs-inl.h"
#include "catena/core/blocks/squares_in_range.h"
#include "catena/core/blocks/store_pairs-inl.h"
#include "catena/core/blocks/tests-inl.h"
#include "catena/core/blocks/window_filter.h"
#include "catena/core/executor/pair_collector.h"
#include "hwy/cache_control.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Pairs of blocks that may collide, of which the colliding spheres are reported. Sink as for BlockSearch.
template <class Sink>
class LeafPairs {
 public:
  LeafPairs(const ChainView& chain, const BlockTree& tree, BlockQueues& queues, PairCollector::Lane& lane,
            const Sink& sink)
      : chain_(chain), tree_(tree), queues_(queues), lane_(lane), sink_(sink) {}

  /// Blocks a <= b, to be looked into; room for a row's, then call make_room.
  void add(std::uint32_t a, std::uint32_t b) { queues_.add_pair({a, b}); }
  void make_room() {
    if (queues_.pairs_full()) flush();
  }

  void flush() { scale_ != 1 ? flush_as<true>() : flush_as<false>(); }

 private:
  static constexpr std::uint32_t block = BlockTree::block;
  using Bits = hn::RebindToUnsigned<Lanes8::Tag>;

  template <bool scaled>
  HWY_INLINE void flush_as() {
    const auto pairs = queues_.pairs();
    constexpr std::size_t ahead = 6;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (k + ahead < pairs.size()) {
        for (const std::uint32_t b : {pairs[k + ahead].i, pairs[k + ahead].j}) {
          const Sphere* const s = tree_.spheres(chain_, b);
          hwy::Prefetch(s), hwy::Prefetch(s + 4);
        }
      }
      meet<scaled>(pairs[k].i, pairs[k].j);
    }
    queues_.clear_pairs();
    decide();
    hand_over();
  }

  /// What the spheres of these blocks are looked at times: 1 where scaling would lose a bit of one of them.
  /// What grows, to below 2^20, loses none.
  HWY_INLINE float scale_of(const Sphere* a, const Sphere* b) const {
    if (scale_ > 1 || (SphereLanes(a).scale_exactly(scale_) && SphereLanes(b).scale_exactly(scale_)))
      return scale_;
    return 1;
  }

  /// Spheres of block a against those of block b; of a block with itself, each pair once. Most blocks that
  /// are met have no spheres that may overlap: what is certain, and who it is, is asked only where there are.
  template <bool scaled>
  void meet(std::uint32_t a, std::uint32_t b) {
    const Sphere *sa = tree_.spheres(chain_, a), *sb = tree_.spheres(chain_, b);
    if constexpr (Sink::listens) account(a, b);
    [[maybe_unused]] Sphere scaled_a[block], scaled_b[block];
    if constexpr (scaled) {
      const float scale = scale_of(sa, sb);
      scale_spheres(sa, scale, scaled_a), scale_spheres(sb, scale, scaled_b);
      sa = scaled_a, sb = scaled_b;
    }
    const SphereLanes of_b(sb);
    Flags<block> near[block];
    for (std::uint32_t p = 0; p < block; ++p) near[p] = SphereLanes::may_overlap(of_b.squares(sa[p]), slack_);
    const auto any =
        ((near[0] | near[1]) | (near[2] | near[3])) | ((near[4] | near[5]) | (near[6] | near[7]));
    if (any.none()) return;
    std::uint64_t may = 0;
    for (std::uint32_t p = 0; p < block; ++p) may |= std::uint64_t{near[p].bits()} << (block * p);
    if (tree_.first[a] & BlockTree::unfilled) may &= (std::uint64_t{1} << block * tree_.filled[a]) - 1;
    if (a == b)
      may &= inside_;
    else if (window_is_all_ && tree_.first[b] == tree_.first[a] + block)
      may &= next_;
    if (may == 0) return;
    const std::uint32_t begin = tree_.begin_of(a);
    const IndexRange indices{tree_.begin_of(b), tree_.end_of(b)};
    while (may != 0) {
      const std::uint32_t p = static_cast<std::uint32_t>(std::countr_zero(may)) / block;
      row(begin + p, sa[p], indices, of_b);
      may &= ~std::uint64_t{0} << (block * p) << block;
    }
    if (hit_count_ > BlockQueues::hit_limit) hand_over();
    if (open_.full()) decide();
  }

  struct IndexRange {
    std::uint32_t begin, end;
  };

  /// Sphere i, and those of block b, which are these.
  HWY_INLINE void row(std::uint32_t i, const Sphere& sphere, IndexRange b, const SphereLanes& of_b) {
    // Who may be no neighbour: indices from `first` to the end of the block.
    const std::uint64_t first = std::uint64_t{i} + window_ + 1;
    if (first >= b.end) return;
    const SphereLanes::Squares squares = of_b.squares(sphere);
    const Flags<block> may = SphereLanes::may_overlap(squares, slack_),
                       certain = SphereLanes::overlap_for_certain(squares, slack_);
    const auto from = static_cast<std::uint32_t>(first);
    for (std::size_t k = 0; k < Lanes8::parts; ++k) {
      const Bits bits;
      const auto j = count_up(bits, b.begin + static_cast<std::uint32_t>(k * Lanes8::width));
      const auto wanted = hn::Lt(hn::Sub(j, hn::Set(bits, from)), hn::Set(bits, b.end - from));
      auto keep = hn::And(hn::RebindMask(bits, may.part[k]), wanted);
      const auto open = hn::AndNot(hn::RebindMask(bits, certain.part[k]), keep);
      if (HWY_UNLIKELY(!hn::AllFalse(bits, open))) {
        open_.add(bits, i, j, open);
        keep = hn::AndNot(open, keep);
      }
      hit_count_ += store_pairs(bits, i, j, keep, hits_ + hit_count_);
    }
  }

  HWY_NOINLINE void decide() {
    queues_.add_open(open_.size());
    report(open_.decide());
  }
  void hand_over() {
    report({hits_, hit_count_});
    hit_count_ = 0;
  }
  void report(std::span<Pair> hits) {
    lane_.collide(std::span<const Pair>(window_is_all_ ? hits : filter_.without_neighbours(hits)));
  }

  /// Of a block and that which begins `ahead` spheres after it: pairs q after p that the index window allows.
  std::uint64_t wanted_from(std::uint32_t ahead) const {
    const bool window = chain_.exclusion.rule == Exclusion::Rule::index_window;
    const std::uint64_t nearest = window ? std::uint64_t{chain_.exclusion.window} + 1 : 1;
    std::uint64_t bits = 0;
    for (std::uint64_t p = 0; p < block; ++p) {
      const std::uint64_t first = p + nearest > ahead ? p + nearest - ahead : 0;  // of q
      if (first < block) bits |= (0xFFull << first & 0xFFull) << (block * p);
    }
    return bits;
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
  BlockQueues& queues_;
  PairCollector::Lane& lane_;
  const Sink& sink_;
  /// The index window alone makes neighbours, of one strand; else it is not asked before the rest is known.
  const bool window_is_all_ = chain_.exclusion.one_open_strand && chain_.exclusion.extra_row == nullptr &&
                              chain_.exclusion.rule == Exclusion::Rule::index_window;
  const std::uint32_t window_ = window_is_all_ ? chain_.exclusion.window : 0;
  /// Not 1 where squares of radii or their sums leave binary32's range: then all is looked at times this
  /// power of two, where that is exact.
  const float scale_ = squares_in_range(chain_.extent.greatest_radius) ? 1 : tree_.scale;
  /// Bit 8 p + q: sphere p of a block and q of the same one, or of the next along the chain, are to be
  /// compared: without neighbours, of which most of these pairs are.
  const std::uint64_t inside_ = wanted_from(0), next_ = wanted_from(block);
  const float slack_ = SphereLanes::overlap_slack * tree_.doubt;
  OpenPairs open_{chain_};
  Pair* const hits_ = queues_.hits();
  std::size_t hit_count_ = 0;
};

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
