#pragma once
#include <stdexcept>

#include "catena/core/export.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/strategy/evidence.h"
#include "catena/core/strategy/moved.h"
#include "catena/core/strategy/plan.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/resident.h"

namespace catena {

/// One of the two stages of a strategy. A construction and a traversal combine when they make and take the
/// same Tree type: plain pointers, valid in one memory, with `height`, its levels from root to leaf, and a
/// function show_bounds(tree, visitor) beside it.
class CATENA_API Stage {
 public:
  virtual ~Stage() = default;
  /// Like Variant::prepare.
  virtual void prepare(const Request&) {}
  /// Like Variant::plan.
  virtual Plan plan() const { return {}; }
};

/// Stage 1 of the paper's two-stage strategies: a chain becomes a hierarchy, in the stage's own place.
template <class Tree>
class CATENA_API Construction : public Stage {
 public:
  /// On the host: builds the hierarchy, which stays valid until the next build. Does not allocate when n has
  /// not grown. Throws CapacityError past a declared limit on n.
  virtual void build(const ChainView&) {
    throw std::logic_error("build: this construction runs on a device");
  }
  /// Like Variant::update, after a build for as many spheres.
  virtual void update(const ChainView& chain, const Moved&) { build(chain); }
  /// On a device: the same, enqueued and not waited for; hierarchy() is known at once.
  virtual void enqueue(const ChainView&, StreamHandle) {
    throw std::logic_error("enqueue: this construction runs on the host");
  }
  /// Its height must be the true one: past Traversal::most_levels no traversal is asked to hold it.
  virtual Tree hierarchy() const = 0;
};

/// Stage 2: a chain and its hierarchy, both in the stage's own place, become collisions.
template <class Tree>
class CATENA_API Traversal : public Stage {
 public:
  /// On the host: fills `result`.
  virtual void find(const ChainView&, const Tree&, const Request&, Collisions&) {
    throw std::logic_error("find: this traversal runs on a device");
  }
  /// On a device: like ResidentSearch::enqueue_find, into an answer that was cleared.
  virtual void enqueue(const ChainView&, const Tree&, const Request&, const ResidentAnswer&, StreamHandle) {
    throw std::logic_error("enqueue: this traversal runs on the host");
  }
  virtual void mend(const ResidentState&) {}  ///< like ResidentSearch::mend
  /// The highest hierarchy that it holds a stack for; a higher one is refused when it is built.
  virtual std::uint32_t most_levels() const { return max_hierarchy_height; }
  virtual Accounting evidence() const { return Accounting::none; }  ///< like Variant::evidence
  /// Like Variant::find_with_evidence; nodes are named by the ids that show_bounds gives them.
  virtual void find_with_evidence(const ChainView&, const Tree&, const Request&, Collisions&, EvidenceSink&) {
    throw std::logic_error("find_with_evidence: this traversal has no evidence");
  }
};

}  // namespace catena
