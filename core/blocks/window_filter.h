#pragma once
#include <algorithm>

#include "catena/core/chain/chain_view.h"
#include "catena/core/pair.h"

namespace catena {

/// Who of many pairs that overlap are neighbours. Under an index window, where no strand is closed and there
/// are no extra pairs, none are that are further apart in number, whatever strands they are of: that is told
/// without a look at them.
class WindowFilter {
 public:
  /// O(strands).
  explicit WindowFilter(const ChainView& chain) : chain_(chain), furthest_(furthest(chain)) {}

  /// i < j.
  bool neighbours(const Pair& pair) const {
    return pair.j - pair.i <= furthest_ && chain_.neighbours(pair.i, pair.j);
  }

 private:
  static bool is_set(std::uint8_t flag) { return flag != 0; }
  static std::uint32_t furthest(const ChainView& chain) {
    const ExclusionView& rule = chain.exclusion;
    const std::uint8_t* const flags = rule.strand_closed;
    const bool closed = !rule.one_open_strand &&
                        std::find_if(flags, flags + chain.strand_count, is_set) != flags + chain.strand_count;
    const bool window_is_all =
        rule.rule == Exclusion::Rule::index_window && rule.extra_row == nullptr && !closed;
    return window_is_all ? rule.window : ~0u;
  }

  const ChainView& chain_;
  const std::uint32_t furthest_;
};

}  // namespace catena
