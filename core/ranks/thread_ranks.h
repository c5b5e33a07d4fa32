#pragma once
#include <functional>

#include "catena/core/ranks/communicator.h"

namespace catena::ranks {

/// Runs `work` on so many ranks within this process, a thread each, and returns when all are done. What they
/// send is handed over in memory. When one throws, all end: throws what the lowest rank of those that threw
/// has thrown, RankFailed last; CapacityError, before any begins, when the system gives fewer threads.
void run_in_threads(unsigned ranks, const std::function<void(Communicator&)>& work);

}  // namespace catena::ranks
