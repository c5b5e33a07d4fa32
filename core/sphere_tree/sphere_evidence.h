#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/sphere_tree/sphere_tree.h"
#include "catena/core/strategy/evidence.h"

namespace catena {

/// The nodes of a SphereTree as evidence names them.
class CATENA_API SphereNodes {
 public:
  /// The tree must outlive this; ids are first_id and following.
  SphereNodes(const SphereTree& tree, std::uint32_t first_id);

  std::uint32_t end_id() const { return first_of_.back(); }
  std::uint32_t node(std::size_t level, std::uint32_t k) const { return first_of_[level] + k; }
  void show(BoundsVisitor& visitor) const;

 private:
  Box64 bound(std::size_t level, std::uint32_t k) const;

  const SphereTree& tree_;
  std::vector<std::uint32_t> first_of_;  ///< [level]
};

/// What a search of a SphereTree tells of itself.
class SphereEvidence {
 public:
  static constexpr bool listens = true;

  /// All must outlive this.
  SphereEvidence(const ChainView& chain, const SphereNodes& nodes, EvidenceSink& sink)
      : chain_(chain), nodes_(nodes), sink_(sink) {}

  void compared(std::uint32_t i, std::uint32_t j) const {
    chain_.neighbours(i, j) ? sink_.excluded(i, j) : sink_.tested(i, j);
  }
  /// Two nodes, a of level l, by their boxes; a sphere and a node of level 0.
  void nodes_apart(std::size_t l, std::uint32_t a, std::size_t level, std::uint32_t k) const {
    apart(nodes_.node(l, a), nodes_.node(level, k));
  }
  void sphere_apart(std::uint32_t i, std::uint32_t node) const { apart(i, nodes_.node(0, node)); }

 private:
  void apart(std::uint32_t a, std::uint32_t b) const {
    sink_.compared(a, b);
    sink_.discarded(a, b);
  }

  const ChainView& chain_;
  const SphereNodes& nodes_;
  EvidenceSink& sink_;
};

/// Costs nothing.
struct NoSphereEvidence {
  static constexpr bool listens = false;
};

}  // namespace catena
