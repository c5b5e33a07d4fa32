#pragma once
#include <string_view>

namespace catena::ranks {

/// For tests: where the environment's CATENA_RANK_FAULT is "PHASE:RANK:KIND" of this phase and rank, it goes wrong here.
/// KIND is `error`, `memory` (there is none left) or `end` (the process is killed). A phase is one of a search, `read` or
/// `write`.
void meet_fault(std::string_view phase, unsigned rank);

}  // namespace catena::ranks
