#pragma once
#include <cstdint>
#include <vector>

namespace catena::reference {

/// The shape of a hierarchy of any width, from its (parent, child) pairs.
struct TreeShape {
  std::uint64_t nodes = 0;        ///< different ids, leaves among them; 0 when no hierarchy was shown
  std::uint64_t roots = 0;        ///< nodes without a parent
  std::uint64_t shared = 0;       ///< nodes with more than one parent, or twice below the same
  std::uint64_t leaves = 0;       ///< leaves below the roots, each counted once
  std::uint64_t lost_leaves = 0;  ///< spheres of the chain that no root reaches
  std::uint64_t lost_inner = 0;   ///< nodes that no root reaches: a cycle
  std::uint64_t barren = 0;       ///< inner nodes without children, and leaves with some
  std::uint32_t depth = 0;        ///< levels on the longest way from a root to a node

  /// One root, and every sphere of the chain below it exactly once; or no hierarchy at all.
  bool is_tree() const {
    return nodes == 0 || (roots == 1 && shared == 0 && lost_leaves == 0 && lost_inner == 0 && barren == 0);
  }
};

/// Gathers (parent, child) pairs in any order; ids below `leaves` are leaves.
class TreeShapeBuilder {
 public:
  explicit TreeShapeBuilder(std::uint32_t leaves) : leaves_(leaves) {}
  void add(std::uint32_t parent, std::uint32_t child) { edges_.push_back({parent, child}); }
  TreeShape shape() const;  ///< O(e log e) for e pairs

 private:
  struct Edge {
    std::uint32_t parent, child;
  };
  std::uint32_t leaves_;
  std::vector<Edge> edges_;
};

}  // namespace catena::reference
