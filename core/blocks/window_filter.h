#pragma once
#include <algorithm>
#include <span>

#include "catena/core/chain/chain_view.h"
#include "catena/core/pair.h"
#include "hwy/cache_control.h"

namespace catena {

/// Who of many pairs that overlap are neighbours. Under an index window, where no strand is closed and there
/// are no extra pairs, none are that are further apart in number, whatever strands they are of: that is told
/// without a look at them, and of others it is enough that they are of one strand.
class WindowFilter {
 public:
  /// O(strands).
  explicit WindowFilter(const ChainView& chain) : chain_(chain), furthest_(furthest(chain)) {}

  /// i < j.
  bool neighbours(const Pair& pair) const {
    if (pair.j - pair.i > furthest_) return false;
    if (furthest_ == any) return chain_.neighbours(pair.i, pair.j);
    const ExclusionView& rule = chain_.exclusion;
    return rule.one_open_strand || rule.strand_of[pair.i] == rule.strand_of[pair.j];
  }

  /// Those that are none, in their order, moved to the front. Pairs found in the order of space ask for what
  /// lies anywhere in memory: it is fetched some pairs ahead, and no branch depends on it.
  std::span<Pair> without_neighbours(std::span<Pair> pairs) const {
    constexpr std::size_t ahead = 16;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (k + ahead < pairs.size()) prefetch(pairs[k + ahead]);
      const Pair pair = pairs[k];
      pairs[kept] = pair;
      kept += !neighbours(pair);
    }
    return pairs.first(kept);
  }

 private:
  static constexpr std::uint32_t any = ~0u;

  void prefetch(const Pair& pair) const {
    const ExclusionView& rule = chain_.exclusion;
    if (pair.j - pair.i > furthest_) return;
    for (const std::uint32_t k : {pair.i, pair.j}) {
      if (!rule.one_open_strand) hwy::Prefetch(rule.strand_of + k);
      if (rule.rule == Exclusion::Rule::arc_window) hwy::Prefetch(rule.arc + k);
    }
  }

  static bool is_set(std::uint8_t flag) { return flag != 0; }
  static std::uint32_t furthest(const ChainView& chain) {
    const ExclusionView& rule = chain.exclusion;
    const std::uint8_t* const flags = rule.strand_closed;
    const bool closed = !rule.one_open_strand &&
                        std::find_if(flags, flags + chain.strand_count, is_set) != flags + chain.strand_count;
    const bool window_is_all =
        rule.rule == Exclusion::Rule::index_window && rule.extra_row == nullptr && !closed;
    return window_is_all ? std::min(rule.window, any - 1) : any;
  }

  const ChainView& chain_;
  const std::uint32_t furthest_;
};

}  // namespace catena
