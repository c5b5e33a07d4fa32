#pragma once
#include "catena/core/export.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// What a variant is, too, whose evidence names other nodes than those of a hierarchy that it has: parts of a
/// chain that are searched in several ways have a tree for each, and cells are no tree at all.
class CATENA_API EvidenceNodes {
 public:
  virtual ~EvidenceNodes() = default;

  /// Every (parent, child) of the nodes that find_with_evidence will name, on the chain of the last build or
  /// update. Trees follow one another, each after a call of tree(); a sphere is in some of them, once in
  /// each, an inner node in one.
  virtual void visit_evidence(const Chain& chain, BoundsVisitor& visitor) const = 0;
};

/// Shows the nodes that the evidence of any variant names, on the chain of its last build or update: by
/// default those of its hierarchy.
inline void visit_evidence_nodes(const Variant& variant, const Chain& chain, BoundsVisitor& visitor) {
  if (const auto* nodes = dynamic_cast<const EvidenceNodes*>(&variant))
    nodes->visit_evidence(chain, visitor);
  else
    variant.visit_bounds(visitor);
}

}  // namespace catena
