#pragma once
#include "catena/core/ranks/communicator.h"

namespace catena::ranks {

/// The ranks of this run. Only within a command that a launcher runs.
Communicator& world();

}  // namespace catena::ranks
