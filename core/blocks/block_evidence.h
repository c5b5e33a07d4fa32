#pragma once
#include <cstdint>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/strategy/evidence.h"

namespace catena {

/// The ids of a BlockTree's nodes, and what a search tells of them. Below n spheres, then blocks, then
/// the nodes of each level.
class BlockEvidence {
 public:
  static constexpr bool listens = true;

  /// Both must outlive this.
  BlockEvidence(const ChainView& chain, const BlockTree& tree, EvidenceSink& sink)
      : chain_(chain), tree_(tree), sink_(sink) {}

  void compared(std::uint32_t i, std::uint32_t j) const {
    chain_.neighbours(i, j) ? sink_.excluded(i, j) : sink_.tested(i, j);
  }
  void blocks_apart(std::uint32_t a, std::uint32_t b) const { apart(block_id(a), block_id(b)); }
  void blocks_near(std::uint32_t a, std::uint32_t b) const { sink_.compared(block_id(a), block_id(b)); }
  void nodes_apart(std::size_t l, std::uint32_t a, std::uint32_t b) const {
    apart(node_id(l, a), node_id(l, b));
  }
  void nodes_near(std::size_t l, std::uint32_t a, std::uint32_t b) const {
    sink_.compared(node_id(l, a), node_id(l, b));
  }
  /// Child a of a node of level l and node b of that level.
  void child_apart(std::size_t l, std::uint32_t a, std::uint32_t b) const {
    apart(child_id(l, a), node_id(l, b));
  }
  /// Without a comparison: children of node k of level l that do not follow one another, and those of nodes k
  /// and k + 1 but for the last of the one and the first of the other.
  void in_a_row(std::size_t l, std::uint32_t k) const;
  void with_the_next(std::size_t l, std::uint32_t k) const;
  /// Of the pairs within block b, or of b with b + 1, those of spheres that are not next to one another are
  /// apart.
  void ordered_inside(std::uint32_t b) const;
  void ordered_between(std::uint32_t b) const;

  std::uint32_t block_id(std::uint32_t b) const { return chain_.size + b; }
  std::uint32_t node_id(std::size_t level, std::uint32_t k) const;

 private:
  /// Of a node of level l.
  std::uint32_t child_id(std::size_t l, std::uint32_t child) const {
    return l == 0 ? block_id(child) : node_id(l - 1, child);
  }
  void apart(std::uint32_t a, std::uint32_t b) const {
    sink_.compared(a, b);
    sink_.discarded(a, b);
  }

  const ChainView& chain_;
  const BlockTree& tree_;
  EvidenceSink& sink_;
};

/// Costs nothing.
struct NoBlockEvidence {
  static constexpr bool listens = false;
  void compared(std::uint32_t, std::uint32_t) const {}
  void blocks_apart(std::uint32_t, std::uint32_t) const {}
  void nodes_apart(std::size_t, std::uint32_t, std::uint32_t) const {}
  void child_apart(std::size_t, std::uint32_t, std::uint32_t) const {}
  void blocks_near(std::uint32_t, std::uint32_t) const {}
  void nodes_near(std::size_t, std::uint32_t, std::uint32_t) const {}
  void in_a_row(std::size_t, std::uint32_t) const {}
  void with_the_next(std::size_t, std::uint32_t) const {}
  void ordered_inside(std::uint32_t) const {}
  void ordered_between(std::uint32_t) const {}
};

/// A capsule as it is shown, whose fields lie so many numbers apart; `unit` is that of the chain in the
/// tree's.
Capsule64 shown_capsule(const float* fields, std::uint32_t stride, double unit);

/// Shows a tree as BlockEvidence names it. Bounds are in the chain's own units.
CATENA_API void show_blocks(const ChainView& chain, const BlockTree& tree, BoundsVisitor& visitor);

}  // namespace catena
