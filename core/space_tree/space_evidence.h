#pragma once
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/node_parts.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/space_tree/space_tree.h"
#include "catena/core/strategy/evidence.h"

namespace catena {

/// The nodes of a SpaceTree as evidence names them. An entry is its box, and in that its capsule.
class CATENA_API SpaceNodes {
 public:
  /// All must outlive this; ids are first_id and following.
  SpaceNodes(const ChainView& chain, const BlockTree& tree, const SpaceTree& space, std::uint32_t first_id);

  std::uint32_t end_id() const { return end_id_; }
  NodeParts box(std::uint32_t entry) const { return part(entry, first_id_ + entry); }
  NodeParts capsule(std::uint32_t entry) const { return part(entry, first_id_ + space_.entries + entry); }
  /// Node k of level >= 1 of space.boxes.
  NodeParts node(std::size_t level, std::uint32_t k) const { return nodes_[level - 1][k]; }
  /// That sphere i is in, or NodeParts::none.
  std::uint32_t entry_of(std::uint32_t i) const { return entry_of_[i]; }
  void show(BoundsVisitor& visitor) const;

 private:
  NodeParts part(std::uint32_t entry, std::uint32_t id) const {
    return NodeParts::one(id, space_.dense_entry[entry] != 0);
  }
  Box64 bound(std::size_t level, std::uint32_t k) const;

  const BlockTree& tree_;
  const SpaceTree& space_;
  const std::uint32_t first_id_;
  std::uint32_t end_id_;
  std::vector<std::vector<NodeParts>> nodes_;  ///< [level - 1]
  std::vector<std::uint32_t> entry_of_;
};

/// What a search of a SpaceTree tells of itself.
class SpaceEvidence {
 public:
  static constexpr bool listens = true;

  /// All must outlive this.
  SpaceEvidence(const ChainView& chain, const SpaceNodes& nodes, EvidenceSink& sink)
      : chain_(chain), nodes_(nodes), sink_(sink) {}

  void compared(std::uint32_t i, std::uint32_t j) const {
    chain_.neighbours(i, j) ? sink_.excluded(i, j) : sink_.tested(i, j);
  }
  // By boxes: two entries, a node of level 1 and an entry, and such a node and any.
  void boxes_apart(std::uint32_t entry, std::uint32_t other) const {
    apart(nodes_.box(entry), nodes_.box(other));
  }
  void box_apart(std::uint32_t node, std::uint32_t entry) const {
    apart(nodes_.node(1, node), nodes_.box(entry));
  }
  void nodes_apart(std::uint32_t node, std::size_t level, std::uint32_t k) const {
    apart(nodes_.node(1, node), nodes_.node(level, k));
  }
  void capsules_apart(std::uint32_t entry, std::uint32_t other) const {
    apart(nodes_.capsule(entry), nodes_.capsule(other));
  }
  /// Of two entries that may collide, of blocks that follow one another: the search along the chain has them.
  void left_to_blocks(std::uint32_t entry, std::uint32_t other) { left_.insert(key(entry, other)); }

  /// Whether spheres i and j were, or are of one entry.
  bool were_left_to_blocks(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t a = nodes_.entry_of(i), b = nodes_.entry_of(j);
    return a == b || left_.contains(key(a, b));
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
  }
  void apart(const NodeParts& a, const NodeParts& b) const {
    NodeParts::for_each_pair(a, b, [&](std::uint32_t p, std::uint32_t q) {
      sink_.compared(p, q);
      sink_.discarded(p, q);
    });
  }

  const ChainView& chain_;
  const SpaceNodes& nodes_;
  EvidenceSink& sink_;
  std::unordered_set<std::uint64_t> left_;
};

/// Costs nothing.
struct NoSpaceEvidence {
  static constexpr bool listens = false;
  void compared(std::uint32_t, std::uint32_t) const {}
  void capsules_apart(std::uint32_t, std::uint32_t) const {}
};

}  // namespace catena
