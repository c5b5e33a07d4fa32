#pragma once
#include <string>

#include "catena/core/readers/binary_chain.h"

namespace catena::ranks {

/// A file that ranks read parts of, by MPI-IO. Each opens it for itself, so that one that cannot leaves none
/// waiting. Throws InputError, naming the file and the reason.
BinaryChain open_shared(const std::string& name);

}  // namespace catena::ranks
