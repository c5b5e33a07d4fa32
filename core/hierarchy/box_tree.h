#pragma once
#include <cstdint>

#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/hierarchy/box.h"

namespace catena {

/// A binary tree of boxes in preorder over the spheres in an order of its own: plain pointers, valid on the
/// host. The left child of an inner node follows it, the right one follows the left one's subtree. So what
/// comes after a node's subtree comes after it in the array, and a search needs no stack.
struct BoxTree {
  struct Node {
    Box box;
    std::uint32_t skip;   ///< the node after this one's subtree; of a leaf the next one
    std::uint32_t first;  ///< position of the first sphere below it
  };
  struct Item {
    Sphere sphere;
    std::uint32_t id;  ///< its index in the chain
  };
  const Node* node;      ///< `nodes` of them, then one whose `first` is the number of spheres
  const Item* item;      ///< spheres in the tree's order, those of a leaf side by side
  std::uint32_t nodes;   ///< 0: no spheres
  std::uint32_t height;  ///< levels from the root to a sphere

  bool is_leaf(std::uint32_t k) const { return node[k].skip == k + 1; }
  std::uint32_t begin(std::uint32_t k) const { return node[k].first; }
  std::uint32_t end(std::uint32_t k) const { return node[node[k].skip].first; }
  std::uint32_t spheres() const { return nodes == 0 ? 0 : node[nodes].first; }
  /// As evidence and show_bounds name node k: spheres come first.
  std::uint32_t id(std::uint32_t k) const { return spheres() + k; }
};

/// Shows each node's children: nodes with their boxes, and spheres, of which no bound is kept. O(n).
inline void show_bounds(const BoxTree& tree, BoundsVisitor& visitor) {
  visitor.tree({.levels = tree.height});
  for (std::uint32_t k = 0; k < tree.nodes; ++k) {
    const auto edge = [&](std::uint32_t child, const AnyBound& bound) {
      visitor.edge(tree.id(k), tree.node[k].box.shown(), child, bound);
    };
    if (tree.is_leaf(k)) {
      for (std::uint32_t at = tree.begin(k); at < tree.end(k); ++at) edge(tree.item[at].id, Everything{});
    } else {
      for (const std::uint32_t child : {k + 1, tree.node[k + 1].skip})
        edge(tree.id(child), tree.node[child].box.shown());
    }
  }
}

}  // namespace catena
