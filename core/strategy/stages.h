#pragma once
#include <stdexcept>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/strategy/evidence.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// Stage 1 of the paper's two-stage strategies: a chain becomes a hierarchy. Both live in the stage's own
/// space.
template <class Bound>
class CATENA_API Construction {
 public:
  virtual ~Construction() = default;
  /// Builds the hierarchy, which stays valid until the next build. Does not allocate when n has not grown.
  /// Throws CapacityError past a declared limit on n.
  virtual void build(const ChainView& chain) = 0;
  /// Its height must be the true one: past max_hierarchy_height no traversal is asked to hold it.
  virtual HierarchyView<Bound> hierarchy() const = 0;
  /// Milliseconds of the last build by the stage's own clock (CUDA events); negative: the caller's wall clock
  /// counts.
  virtual double own_ms() const { return -1; }
};

/// Stage 2: a chain and its hierarchy, both in the stage's own space, become collisions on the host.
template <class Bound>
class CATENA_API Traversal {
 public:
  virtual ~Traversal() = default;
  virtual void find(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
                    Collisions& result) = 0;
  virtual Accounting evidence() const { return Accounting::none; }  ///< like Variant::evidence
  /// Like Variant::find_with_evidence; nodes are named by their slots.
  virtual void find_with_evidence(const ChainView&, const HierarchyView<Bound>&, const Request&, Collisions&,
                                  EvidenceSink&) {
    throw std::logic_error("find_with_evidence: this traversal has no evidence");
  }
  /// Like Construction::own_ms.
  virtual double own_ms() const { return -1; }
  /// The part of the last find that moved results to the host.
  virtual double own_transfer_ms() const { return 0; }
};

}  // namespace catena
