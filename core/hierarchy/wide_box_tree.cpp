#include "catena/core/hierarchy/wide_box_tree.h"

#include <algorithm>
#include <limits>

namespace catena {

void WideBoxTree::clear(std::uint32_t boxes) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Group empty;
  for (int d = 0; d < 3; ++d) empty.low[d].fill(infinity), empty.high[d].fill(-infinity);
  std::size_t l = 0;
  for (;; ++l) {
    const std::uint32_t groups = std::max(1u, (boxes + fan - 1) / fan);
    if (l == levels_.size()) levels_.emplace_back();
    levels_[l].assign(groups, empty);
    if (groups == 1) break;
    boxes = groups;
  }
  levels_.resize(l + 1);
}

Box WideBoxTree::box(std::uint32_t k) const {
  const Group& g = levels_[0][k / fan];
  Box box;
  for (int d = 0; d < 3; ++d) box.low[d] = g.low[d][k % fan], box.high[d] = g.high[d][k % fan];
  return box;
}

Box WideBoxTree::around(const Group& group) {
  Box box;
  for (int d = 0; d < 3; ++d) {
    // By halves, as vectors take it.
    std::array<float, fan> low = group.low[d], high = group.high[d];
    for (std::uint32_t half = fan / 2; half > 0; half /= 2)
      for (std::uint32_t k = 0; k < half; ++k)
        low[k] = std::min(low[k], low[k + half]), high[k] = std::max(high[k], high[k + half]);
    box.low[d] = low[0], box.high[d] = high[0];
  }
  return box;
}

void WideBoxTree::refresh(std::uint32_t first, std::uint32_t end) {
  if (first >= end) return;
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    first /= fan, end = (end - 1) / fan + 1;
    for (std::uint32_t g = first; g < end; ++g) set(l + 1, g, around(levels_[l][g]));
  }
}

}  // namespace catena
