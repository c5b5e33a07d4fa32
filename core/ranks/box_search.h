#pragma once
#include <optional>

#include "catena/core/chain/chain.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// As search, in a space that a box repeats (see Periodic). Rank 0, which alone has the chain, adds the
/// images at the faces of the box, with ids of their own; all ranks search that chain, each a part of it;
/// rank 0 decides what they found exactly and tells each rank the answer about its own spheres, as many as
/// the others have, give or take one. So rank 0 holds the chain, its images and those pairs that Periodic
/// asks for. For yes or no all search the chain first as it is stored. Throws as search, and on rank 0 as
/// Periodic::build does: call it within together.
RankAnswer search_in_box(Communicator& ranks, const std::optional<Chain>& chain, const PeriodicBox& box,
                         const RankOptions& options, RankWork& work);

}  // namespace catena::ranks
