#pragma once
#include <span>

#include "catena/core/chain/chain_view.h"
#include "catena/core/pair.h"
#include "hwy/cache_control.h"

namespace catena {

/// Who of many pairs that overlap are neighbours. Most are told by their numbers, without a look at them; and
/// under an index window, without extra pairs, those that may be are if they are of one strand.
class WindowFilter {
 public:
  explicit WindowFilter(const ChainView& chain)
      : chain_(chain),
        reach_(chain.exclusion.id == nullptr ? chain.reach : NeighbourReach{}),
        by_strand_(chain.exclusion.rule == Exclusion::Rule::index_window &&
                   chain.exclusion.extra_row == nullptr && chain.exclusion.id == nullptr) {}

  /// i < j.
  bool neighbours(const Pair& pair) const {
    if (reach_.none(pair.i, pair.j)) return false;
    if (!by_strand_ || pair.j - pair.i > reach_.furthest) return chain_.neighbours(pair.i, pair.j);
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
  void prefetch(const Pair& pair) const {
    const ExclusionView& rule = chain_.exclusion;
    if (reach_.none(pair.i, pair.j)) return;
    for (const std::uint32_t k : {pair.i, pair.j}) {
      if (!rule.one_open_strand) hwy::Prefetch(rule.strand_of + k);
      if (rule.rule == Exclusion::Rule::arc_window) hwy::Prefetch(rule.arc + k);
    }
  }

  const ChainView& chain_;
  const NeighbourReach reach_;
  const bool by_strand_;
};

}  // namespace catena
