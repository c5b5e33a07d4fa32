#include "catena/core/frames/run_tree.h"

#include <algorithm>

#include "catena/core/frames/frame_kernels.h"

namespace catena {

void RunTree::refresh(const RunRow& row, std::uint32_t first, std::uint32_t end) {
  const auto partly = [&](std::uint32_t r) {
    Box box = Box::nothing();
    for (std::uint32_t p = std::max(r * run, row.begin); p < std::min((r + 1) * run, row.end); ++p)
      box.join(Box::around(row.places[p]));
    tree_.set(r, box);
  };
  // Runs that lie in the window as a whole come between those that do not.
  const std::uint32_t whole = std::clamp((row.begin + run - 1) / run, first, end),
                      last = std::clamp(row.end / run, whole, end);
  for (std::uint32_t r = first; r < whole; ++r) partly(r);
  set_boxes_of_runs(row.places, whole, last, tree_);
  for (std::uint32_t r = last; r < end; ++r) partly(r);
  tree_.refresh(first, end);
}

void RunTree::search(const ChainView& chain, const RunRow& row, std::uint64_t most,
                     std::vector<Pair>& pairs) const {
  search_runs(chain, row, tree_, most, pairs);
}

}  // namespace catena
