#pragma once
#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "catena/core/blocks/node_parts.h"
#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/hierarchy/range_tree.h"
#include "catena/core/strategy/evidence.h"

namespace catena {

/// A box as a range of a RangeTree.
struct BoxRange {
  Box64 box;

  void join(const BoxRange& other) { RangeTree<BoxRange>::join(box, other.box); }
  bool near(const BoxRange& other) const {
    return box.low.x <= other.box.high.x && other.box.low.x <= box.high.x && box.low.y <= other.box.high.y &&
           other.box.low.y <= box.high.y && box.low.z <= other.box.high.z && other.box.low.z <= box.high.z;
  }
  double side(std::size_t d) const { return high(d) - low(d); }
  double side() const { return std::max({side(0), side(1), side(2)}); }
  double middle(std::size_t d) const { return low(d) / 2 + high(d) / 2; }
  double low(std::size_t d) const { return d == 0 ? box.low.x : d == 1 ? box.low.y : box.low.z; }
  double high(std::size_t d) const { return d == 0 ? box.high.x : d == 1 ? box.high.y : box.high.z; }
};

/// The blocks of a CapsuleBlocks, once all have met, as evidence names them: each a box, in that its capsule,
/// and a RangeTree over the boxes. Crowded blocks are another search's (NodeParts).
class CATENA_API CapsuleNodes {
 public:
  using Tree = RangeTree<BoxRange>;

  /// The blocks, of which there is one, must outlive this; ids are first_id and following.
  CapsuleNodes(const ChainView& chain, const CapsuleBlocks& blocks, std::uint32_t first_id);

  std::uint32_t end_id() const { return end_id_; }
  const Tree& tree() const { return tree_; }
  const NodeParts& parts(const Tree::Node& node) const {
    return parts_[static_cast<std::size_t>(&node - tree_.nodes().data())];
  }
  std::uint32_t capsule_id(std::uint32_t block) const { return first_id_ + blocks_.blocks + block; }
  bool near(std::uint32_t a, std::uint32_t b) const { return box(a).near(box(b)); }
  void show(BoundsVisitor& visitor) const;

 private:
  BoxRange box(std::uint32_t block) const;
  Capsule64 capsule(std::uint32_t block) const;
  std::vector<Tree::Node> leaves() const;

  const std::uint32_t spheres_;
  const CapsuleBlocks& blocks_;
  const std::uint32_t first_id_;
  std::uint32_t end_id_;
  Tree tree_;
  std::vector<NodeParts> parts_;  ///< by place in the tree
};

/// What the comparison of a CapsuleBlocks' blocks tells of itself. Two blocks whose boxes lie apart are
/// accounted for by rest(), whether they were compared or not.
class CATENA_API CapsuleEvidence {
 public:
  /// All must outlive this.
  CapsuleEvidence(const ChainView& chain, const CapsuleBlocks& blocks, const CapsuleNodes& nodes,
                  EvidenceSink& sink)
      : chain_(chain), blocks_(blocks), nodes_(nodes), sink_(sink) {}

  /// Blocks a < b were compared, of which these spheres may collide with the other's capsule.
  void met(std::uint32_t a, std::uint32_t near_a, std::uint32_t b, std::uint32_t near_b);
  void compared(std::uint32_t i, std::uint32_t j) const;

  /// After the search: all that it had no need to look at.
  void rest() const;

 private:
  static constexpr std::uint32_t block = CapsuleBlocks::block;
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }
  /// Sphere k of block b, or none past the last.
  template <class Body>
  void for_each_in(std::uint32_t b, std::uint32_t bits, const Body& body) const {
    for (std::uint32_t k = 0; k < block; ++k)
      if ((bits >> k & 1) != 0 && b * block + k < chain_.size) body(b * block + k);
  }
  void in_order(std::uint32_t a, std::uint32_t b) const;

  const ChainView& chain_;
  const CapsuleBlocks& blocks_;
  const CapsuleNodes& nodes_;
  EvidenceSink& sink_;
  std::unordered_set<std::uint64_t> met_;
};

}  // namespace catena
