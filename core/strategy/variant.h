#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/chain/chain.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/strategy/evidence.h"
#include "catena/core/strategy/moved.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/timings.h"
#include "catena/core/strategy/work_done.h"

namespace catena {

class ResidentSearch;

/// One complete way from chain to collisions; the only contract that the rest of catena knows. A hierarchy,
/// if there is one, is the strategy's own affair. Buffers belong to the variant and are reused. Not
/// thread-safe: one object, one thread at a time.
class CATENA_API Variant {
 public:
  virtual ~Variant() = default;

  /// What finds after the next build will ask for at most, so that a build can leave out what they do not
  /// need. Not called: pairs of the whole chain.
  virtual void prepare(const Request&) {}

  /// Stage 1. All-pairs variants do nothing here. The chain need not outlive the call. Throws CapacityError
  /// past a declared limit of the strategy. After whatever it or update throws nothing is built.
  virtual void build(const Chain& chain) = 0;

  /// Stage 1 again for the same spheres, moved, of which only those of `moved` differ from the last build or
  /// update. What find gives, and the shape of the tree that visit_bounds shows, are those of build; its
  /// bounds enclose, but need not be those of build unless the strategy promises it. What was looked at or
  /// sorted for an earlier frame may serve this one. Does not allocate once warm. Where nothing is built, as
  /// after a build that threw, it builds, whatever `moved` says.
  virtual void update(const Chain& chain, const Moved& moved = {}) {
    static_cast<void>(moved);
    build(chain);
  }

  /// Stage 2, on the chain of the last build or update. Fills `result` as `request` asks; one host thread
  /// allocates nothing when variant and `result` have held as much before. The pair set is that of the
  /// strategy's arithmetic. Throws PairLimitExceeded with the true number, and leaves `result` without pairs.
  /// Throws std::logic_error when there was no such build and one is needed. After anything else that it
  /// throws, want of memory say, the build stands, and find may be asked again.
  virtual void find(const Chain& chain, const Request& request, Collisions& result) = 0;

  virtual Timings timings() const = 0;

  /// What the last build and find did and left out, and why.
  virtual Plan plan() const { return {}; }

  /// How often the last find took each of its steps; also before the first, with zeros. Nothing for
  /// strategies that do not count them.
  virtual std::vector<WorkDone> work() const { return {}; }

  /// What answered the last find, in a few words, where this holds other variants and chooses; else empty.
  virtual std::string answered_by() const { return {}; }

  /// Every (parent, child) of the last build; nothing for strategies without a hierarchy, and where nothing
  /// is built.
  virtual void visit_bounds(BoundsVisitor&) const {}

  /// What find_with_evidence can show; none for strategies that discard nothing or cannot tell.
  virtual Accounting evidence() const { return Accounting::none; }

  /// The same search as find for counts or pairs of all spheres (a search for `any` stops early and proves
  /// nothing), which also tells the sink what it left out. Slower, on one thread. Only when evidence() is not
  /// none.
  virtual void find_with_evidence(const Chain&, const Request&, Collisions&, EvidenceSink&) {
    throw std::logic_error("find_with_evidence: this variant has no evidence");
  }

  /// The search on a chain that is on the device already, its answer left there; nullptr when the variant has
  /// none. It and this object's own build and find share their buffers.
  virtual ResidentSearch* resident() { return nullptr; }
};

}  // namespace catena
