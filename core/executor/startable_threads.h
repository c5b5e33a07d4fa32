#pragma once
#include "catena/core/export.h"

namespace catena {

/// How many threads beside the caller's there can be at once, at most `wanted`: a container may allow few
/// processes, or a shell (ulimit). Where one thread can be started and no tight limit is seen it is all;
/// where addresses are what is limited, half of those that can be started, as a search wants some, too. To be
/// asked before work is shared out: oneTBB tells of a thread that it lacks when work was begun, or not at
/// all. What was once found is kept, unless it was none.
CATENA_API unsigned startable_threads(unsigned wanted);

/// Throws CapacityError, which says that no thread can be started and what to do.
[[noreturn]] CATENA_API void refuse_threads();

}  // namespace catena
