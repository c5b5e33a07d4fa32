#pragma once
#include "catena/core/export.h"

namespace catena {

/// How many cores this process may use, at least 1: fewer than the machine has where it was given some of
/// them (taskset, a container's cpuset).
CATENA_API unsigned usable_cores();

}  // namespace catena
