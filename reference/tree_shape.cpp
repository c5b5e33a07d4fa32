#include "catena/reference/tree_shape.h"

#include <algorithm>
#include <utility>

namespace catena::reference {

TreeShape TreeShapeBuilder::shape() const {
  TreeShape result;
  if (edges_.empty()) return result;

  // Ids are the strategy's own and may be far apart: rename them to 0..nodes-1 in their order, leaves first.
  std::vector<std::uint32_t> ids;
  for (const Edge& e : edges_) ids.insert(ids.end(), {e.parent, e.child});
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const auto renamed = [&](std::uint32_t id) -> std::uint32_t {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(ids, id) - ids.begin());
  };
  result.nodes = ids.size();
  const std::uint64_t leaves_shown = renamed(leaves_);

  auto edges = edges_;
  for (Edge& e : edges) e = {renamed(e.parent), renamed(e.child)};
  std::ranges::sort(edges, {}, &Edge::parent);
  std::vector<std::size_t> first(ids.size() + 1, 0);
  std::vector<std::uint32_t> parents(ids.size(), 0);
  for (const Edge& e : edges) ++first[e.parent + 1], ++parents[e.child];
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const bool childless = first[k + 1] == 0;
    result.barren += childless != (k < leaves_shown);
    result.shared += parents[k] > 1;
    first[k + 1] += first[k];
  }

  // Level by level, so that a deep tree needs no deep stack and a cycle is simply never reached.
  std::vector<std::uint8_t> reached(ids.size(), 0);
  std::vector<std::uint32_t> level, below;
  for (std::uint32_t k = 0; k < ids.size(); ++k)
    if (parents[k] == 0) level.push_back(k), reached[k] = 1;
  result.roots = level.size();
  std::uint64_t total = 0;
  for (; !level.empty(); level.swap(below), below.clear()) {
    ++result.depth;
    total += level.size();
    for (const std::uint32_t node : level) {
      result.leaves += node < leaves_shown;
      for (std::size_t k = first[node]; k < first[node + 1]; ++k)
        if (!std::exchange(reached[edges[k].child], std::uint8_t{1})) below.push_back(edges[k].child);
    }
  }
  result.lost_leaves = leaves_ - result.leaves;
  result.lost_inner = (result.nodes - leaves_shown) - (total - result.leaves);
  return result;
}

}  // namespace catena::reference
