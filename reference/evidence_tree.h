#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/variant.h"
#include "catena/reference/fingerprint.h"

namespace catena::reference {

/// Faults of a tree that evidence speaks of.
struct EvidenceTreeReport {
  std::uint64_t bounds = 0;          ///< (parent, child) seen
  std::uint64_t unenclosed = 0;      ///< children that stick out of their parent
  std::uint64_t foreign_leaves = 0;  ///< leaves that are not the chain's sphere of their index
  std::uint64_t misplaced =
      0;  ///< nodes with two parents, in a cycle, with an id of 4n or more, or shown with two bounds
  bool sound() const { return unenclosed == 0 && foreign_leaves == 0 && misplaced == 0; }
};

/// The nodes of a variant's last build: their bounds, and the weight of the spheres below each. When sound,
/// every node encloses all spheres below it, exactly: it encloses its children, and they theirs. 64 bytes a
/// node.
class EvidenceTree final : public BoundsVisitor {
 public:
  /// `chain` must outlive the tree. Weights are drawn from std::random_device, so no search can know them.
  explicit EvidenceTree(const Chain& chain);

  void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
              const Sphere64& child) override;
  /// Call once when all bounds were shown: adds up weights from the leaves to the roots, O(nodes).
  void complete();

  bool knows(std::uint32_t id) const { return id < nodes_.size() && nodes_[id].known; }
  const Sphere64& bound(std::uint32_t id) const { return nodes_[id].bound; }
  const Fingerprint::Weight& weight(std::uint32_t id) const { return nodes_[id].weight; }
  std::uint64_t all_pairs() const {
    return all_pairs_;
  }  ///< the fingerprint of every ordered pair, each once
  const EvidenceTreeReport& report() const { return report_; }

 private:
  static constexpr std::uint32_t no_parent = 0xFFFFFFFF;
  struct alignas(64) Node {
    Sphere64 bound{};
    Fingerprint::Weight weight;
    std::uint32_t parent = no_parent;
    std::uint32_t open_children : 31 = 0;  ///< whose weight is not in this one yet
    std::uint32_t known : 1 = 0;
  };
  Node* show(std::uint32_t id, const Sphere64& bound);

  const std::uint32_t leaves_;
  std::vector<Node> nodes_;
  std::uint64_t all_pairs_ = 0;
  EvidenceTreeReport report_;
};

}  // namespace catena::reference
