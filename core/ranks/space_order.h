#pragma once
#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/held_part.h"
#include "catena/core/ranks/tops.h"

namespace catena::ranks {

/// How many blocks would have to be looked at by another rank, a block once for each, as a share of all blocks. From a
/// sample of the blocks; the same on all ranks.
double touching_share(Communicator& ranks, const HeldPart& part, const Tops& tops);

/// Parts the spheres of all ranks anew: each rank gets blocks that are near in space, about as many as the others, in
/// order of Morton codes (a sample sort). Consecutive blocks that meet on a rank become one piece again, so that a tube
/// stays a tube. O(part) memory for what is sent and for what comes.
Part part_in_space(Communicator& ranks, const HeldPart& part);

}  // namespace catena::ranks
