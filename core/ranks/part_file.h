#pragma once
#include "catena/core/readers/binary_chain.h"
#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/part.h"

namespace catena::ranks {

/// This rank's part of a file, as many spheres as the others have, give or take one. Each rank reads its own,
/// and no more of the other arrays than concerns it. All ranks call it. Throws InputError as BinaryChain
/// does, or when the part has 2^31 spheres or more.
Part read_part(Communicator& ranks, const BinaryChain& file);

}  // namespace catena::ranks
