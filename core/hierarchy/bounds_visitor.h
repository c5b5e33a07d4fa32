#pragma once
#include <cstdint>

#include "catena/core/export.h"
#include "catena/core/hierarchy/bound.h"

namespace catena {

/// What a strategy says of its tree as a whole.
struct CATENA_API TreeFacts {
  std::uint32_t levels = 0;  ///< from root to leaf, as the builder counted them; 0: it does not count
  /// Each parent's bound encloses the *bounds* of its children: the paper's trees. Otherwise only what every
  /// tree promises: each node's bound encloses all *spheres* below it.
  bool nested = false;
};

/// Receives a hierarchy, for what is asked of all of them: enclosure, shape, evidence. First tree(), then
/// every (parent, child) once, in any order. Ids below n are leaves, the sphere of that index; others are the
/// strategy's own, below 8n where it gives evidence. A block of spheres is a node with those spheres as
/// children.
class CATENA_API BoundsVisitor {
 public:
  virtual ~BoundsVisitor() = default;
  virtual void tree(const TreeFacts&) {}
  /// Bounds are the strategy's own numbers. A child that it stores no bound for, such as a sphere that it
  /// reads from the chain, is shown with Everything.
  virtual void edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
                    const AnyBound& child) = 0;
};

}  // namespace catena
