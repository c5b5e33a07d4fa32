#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/pair.h"

namespace catena {

/// Which nodes of a BlockTree lie among so many others that another search will do better, and which pairs of
/// nodes are left for the tree. A node is crowded once it has met more than `limit` others; a pair of crowded
/// nodes is left out. So the tree's work is bounded by limit times the number of nodes, whatever the chain.
struct Crowding {
  std::uint32_t limit = 0;
  std::vector<std::uint32_t> partners;  ///< of each node: others it met, counted to just above the limit
  std::vector<Pair> pairs;  ///< nodes that met, in the order of the search; both may be crowded by now
  std::vector<std::vector<std::uint32_t>>
      open;  ///< for each level and node: nodes below that are not crowded

  void reset(const BlockTree& tree, std::uint32_t new_limit) {
    limit = new_limit;
    pairs.clear();
    open.resize(tree.level.size());
    for (std::size_t l = 0; l < open.size(); ++l) {
      open[l].assign(tree.level[l].count, l == 0 ? 1 : 0);
      if (l > 0)
        for (std::uint32_t k = 0; k < open[l - 1].size(); ++k)
          open[l][k / BlockTree::group] += open[l - 1][k];
    }
    partners.assign(open.empty() ? 0 : open[0].size(), 0);
  }
  bool crowded(std::uint32_t node) const { return partners[node] > limit; }
  bool left_out(const Pair& nodes) const { return crowded(nodes.i) && crowded(nodes.j); }
  std::uint32_t crowded_nodes() const {
    return open.empty() ? 0 : static_cast<std::uint32_t>(partners.size()) - open.back()[0];
  }

  // What NodeWalk asks for.
  void met(std::uint32_t a, std::uint32_t b) {
    pairs.push_back({a, b});
    for (std::uint32_t k : {a, b}) {
      if (crowded(k) || ++partners[k] <= limit) continue;
      for (auto& level : open) --level[k], k /= BlockTree::group;
    }
  }
  bool left_out(std::size_t l, std::uint32_t a, std::uint32_t b) const {
    return open[l][a] == 0 && open[l][b] == 0;
  }
  bool left_out_group(std::size_t l, std::uint32_t a, std::uint32_t parent) const {
    return open[l][a] == 0 && open[l + 1][parent] == 0;
  }
  bool stop() const { return false; }
};

}  // namespace catena
