#pragma once
#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/part.h"

namespace catena::ranks {

/// How many blocks would have to be looked at by another rank, a block once for each, as a share of all
/// blocks. From a sample of the blocks; the same on all ranks.
double touching_share(Communicator& ranks, const Part& part);

/// Parts the spheres of all ranks anew: each rank gets blocks that are near in space, about as many as the
/// others, by their Morton codes (a sample sort, without the sorting: what a rank gets stays in the order of
/// the chain). Consecutive blocks that meet on a rank become one piece again, so that a tube stays a tube.
/// O(part) time. In rounds, of which none takes from a rank more than `blocks_at_once`; 0: a sixteenth of its
/// own, at least 2^14. Memory: twice the part's spheres, and one round.
Part part_in_space(Communicator& ranks, Part part, std::uint32_t blocks_at_once = 0);

}  // namespace catena::ranks
