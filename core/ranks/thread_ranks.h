#pragma once
#include <functional>

#include "catena/core/ranks/communicator.h"

namespace catena::ranks {

/// Runs `work` on so many ranks within this process, a thread each, and returns when all are done. What they send is
/// handed over in memory. Throws what the lowest rank of those that threw has thrown, RankFailed last; CapacityError
/// where the system starts fewer threads. A rank that ends keeps none waiting: the others' next call fails.
void run_in_threads(unsigned ranks, const std::function<void(Communicator&)>& work);

}  // namespace catena::ranks
