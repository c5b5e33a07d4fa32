#pragma once
#include <cstdint>
#include <stdexcept>

#include "catena/core/chain/chain.h"
#include "catena/core/sphere.h"
#include "catena/core/strategy/evidence.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/timings.h"

namespace catena {

/// Receives the bounds of a hierarchy, for the enclosure and tree-shape properties.
class BoundsVisitor {
 public:
  virtual ~BoundsVisitor() = default;
  /// One parent and one of its children. Ids below n are leaves, the sphere of that index; others are the
  /// strategy's own. Bounds are given in binary64, to which the strategy's own numbers convert exactly; an
  /// infinite radius encloses everything.
  virtual void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
                      const Sphere64& child) = 0;
  /// Levels from root to leaf, as the builder counted them; not called by strategies that do not count.
  virtual void levels(std::uint32_t) {}
};

/// One complete way from chain to collisions; the only contract that the rest of catena knows. A hierarchy,
/// if there is one, is the strategy's own affair. Buffers belong to the variant and are reused. Not
/// thread-safe: one object, one thread at a time.
class Variant {
 public:
  virtual ~Variant() = default;

  /// Stage 1. All-pairs variants do nothing here. Throws CapacityError past a declared limit of the strategy.
  virtual void build(const Chain& chain) = 0;

  /// Stage 1 again for the same spheres, moved. Gives what build would, and does not allocate once warm.
  virtual void update(const Chain& moved) { build(moved); }

  /// Stage 2, on the chain of the last build or update. Fills `result` as `request` asks; one host thread allocates
  /// nothing when variant and `result` have held as much before. The pair set is that of the strategy's arithmetic.
  /// Throws PairLimitExceeded with the true number, and leaves `result` without pairs.
  virtual void find(const Chain& chain, const Request& request, Collisions& result) = 0;

  virtual Timings timings() const = 0;

  /// Every (parent, child) of the last build; nothing for strategies without a hierarchy.
  virtual void visit_bounds(BoundsVisitor&) const {}

  /// What find_with_evidence can show; none for strategies that discard nothing or cannot tell.
  virtual Accounting evidence() const { return Accounting::none; }

  /// The same search as find for counts or pairs (a search for `any` stops early and proves nothing), which also tells
  /// the sink what it left out. Slower, on one thread. Only when evidence() is not none.
  virtual void find_with_evidence(const Chain&, const Request&, Collisions&, EvidenceSink&) {
    throw std::logic_error("find_with_evidence: this variant has no evidence");
  }
};

}  // namespace catena
