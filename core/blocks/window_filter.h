#pragma once
#include <span>

#include "catena/core/chain/chain_view.h"
#include "catena/core/pair.h"

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

  /// Those that are none, in their order, moved to the front. No branch depends on it. To ask for what lies
  /// anywhere in memory some pairs ahead takes longer than to wait for it (1.2 times the search of a melt).
  std::span<Pair> without_neighbours(std::span<Pair> pairs) const {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Pair pair = pairs[k];
      pairs[kept] = pair;
      kept += !neighbours(pair);
    }
    return pairs.first(kept);
  }

 private:
  const ChainView& chain_;
  const NeighbourReach reach_;
  const bool by_strand_;
};

}  // namespace catena
