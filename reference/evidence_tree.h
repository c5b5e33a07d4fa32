#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/reference/bound_tree.h"
#include "catena/reference/fingerprint.h"

namespace catena::reference {

/// The nodes that the evidence of a variant's last build names, of one tree or of several, of any arity and
/// with bounds of any kind, and the weight of the spheres below each. When its tree is sound, every node
/// encloses all spheres below it, exactly. About 80 bytes a node.
class EvidenceTree final : public BoundsVisitor {
 public:
  /// `chain` must outlive the tree. Weights are drawn from std::random_device, so no search can know them.
  explicit EvidenceTree(const Chain& chain);

  void tree(const TreeFacts& facts) override {
    nested_ = facts.nested && (nested_ || trees_ == 0);
    ++trees_;
    tree_.begin_tree();
  }
  void edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
            const AnyBound& child) override {
    tree_.add(parent_id, parent, child_id, child);
  }
  /// Call once when all bounds were shown: checks them, and adds up weights from the leaves to the roots,
  /// O(nodes).
  void complete();

  bool knows(std::uint32_t id) const { return tree_.knows(id); }
  bool separate(std::uint32_t a, std::uint32_t b) const { return tree_.separate(a, b); }
  const Fingerprint::Weight& weight(std::uint32_t id) const { return weights_[id]; }
  std::uint64_t all_pairs() const {
    return all_pairs_;
  }  ///< the fingerprint of every ordered pair, each once
  const BoundTreeFaults& faults() const { return tree_.faults(); }

 private:
  BoundTree tree_;
  bool nested_ = false;  ///< all trees are
  std::uint32_t trees_ = 0;
  std::vector<Fingerprint::Weight> weights_;
  std::uint64_t all_pairs_ = 0;
};

}  // namespace catena::reference
