#pragma once
#include <cstdint>
#include <optional>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {

/// What one search did, counted: the same on every machine and in every run.
struct Work {
  std::uint64_t pair_tests = 0;   ///< pairs of spheres, not neighbours, whose overlap was decided
  std::uint64_t node_visits = 0;  ///< inner nodes whose bound was compared
  /// Read by those tests: one bound a test, the other operand being at hand, and the links of each node that
  /// gave its children.
  std::uint64_t bytes = 0;
  friend bool operator==(const Work&, const Work&) = default;
};

/// The work of build and find on this chain, counted through the search's own evidence
/// (core/strategy/evidence.h) by a second instantiation of its code, so that what is timed is not slowed.
/// Empty when the variant has no evidence, or neither a tree nor all pairs. A device variant is counted by
/// its twin on the host, which runs the same policies, when there is one. Throws CapacityError where the
/// variant refuses the chain.
std::optional<Work> count_work(const VariantInfo& variant, const Chain& chain);

}  // namespace catena::bench
