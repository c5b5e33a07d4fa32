#pragma once
#include <span>
#include <vector>

#include "catena/core/ranks/across.h"
#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/local_search.h"

namespace catena::ranks {

/// Collisions of consecutive spheres.
struct CountRun {
  SphereId first;
  std::span<const std::uint32_t> count;
};

/// Sends what was counted to the ranks that the spheres began on: of spheres in a row, and more of some.
/// Returns the sums for those of this rank. Rank r began with the spheres starts[r], ..., starts[r + 1] - 1.
/// O(spheres + runs log ranks).
std::vector<std::uint64_t> return_counts(Communicator& ranks, std::span<const SphereId> starts,
                                         std::span<const CountRun> runs, std::span<const Counted> more);

/// Sends each pair to the rank that its first sphere began on; returns those of this rank, sorted.
std::vector<IdPair> return_pairs(Communicator& ranks, std::span<const SphereId> starts,
                                 PairLists pairs);

}  // namespace catena::ranks
