#include "catena/core/frames/run_tree.h"

#include <algorithm>
#include <limits>

namespace catena {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Box nothing{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

}  // namespace

void RunTree::clear(std::uint32_t places) {
  Group empty;
  for (int d = 0; d < 3; ++d) empty.low[d].fill(infinity), empty.high[d].fill(-infinity);
  std::size_t l = 0;
  for (std::uint32_t boxes = (places + run - 1) / run;; ++l) {
    const std::uint32_t groups = std::max(1u, (boxes + fan - 1) / fan);
    if (l == levels_.size()) levels_.emplace_back();
    levels_[l].assign(groups, empty);
    if (groups == 1) break;
    boxes = groups;
  }
  levels_.resize(l + 1);
}

Box RunTree::box_of(std::uint32_t of) const {
  const Group& g = levels_[0][of / fan];
  Box box;
  for (int d = 0; d < 3; ++d) box.low[d] = g.low[d][of % fan], box.high[d] = g.high[d][of % fan];
  return box;
}

void RunTree::set(std::size_t level, std::uint32_t node, const Box& box) {
  Group& g = levels_[level][node / fan];
  for (int d = 0; d < 3; ++d) g.low[d][node % fan] = box.low[d], g.high[d][node % fan] = box.high[d];
}

Box RunTree::around(const Group& group) {
  Box box;
  for (int d = 0; d < 3; ++d)
    box.low[d] = *std::ranges::min_element(group.low[d]),
    box.high[d] = *std::ranges::max_element(group.high[d]);
  return box;
}

void RunTree::refresh(const Sphere* row, std::uint32_t window_begin, std::uint32_t window_end,
                      std::uint32_t first, std::uint32_t end) {
  if (first >= end) return;
  for (std::uint32_t r = first; r < end; ++r) {
    Box box = nothing;
    for (std::uint32_t p = std::max(r * run, window_begin); p < std::min((r + 1) * run, window_end); ++p)
      box.join(Box::around(row[p]));
    set(0, r, box);
  }
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    first /= fan, end = (end - 1) / fan + 1;
    for (std::uint32_t g = first; g < end; ++g) set(l + 1, g, around(levels_[l][g]));
  }
}

}  // namespace catena
