#pragma once
#include <chrono>
#include <string_view>

namespace catena::ranks {

/// For tests: where the environment's CATENA_RANK_FAULT has "PHASE:RANK:KIND" of this phase and rank (several
/// are parted by commas), it goes wrong here. KIND is `error`, `memory` (there is none left), `end` (the
/// process is killed) or `busy` (for a minute, without a word to others). A phase is one of a search, `read`
/// or `write`.
void meet_fault(std::string_view phase, unsigned rank);

/// How long a rank that failed waits for others to come to a vote. Tests set CATENA_RANK_PATIENCE, in
/// milliseconds.
std::chrono::milliseconds patience_with_others();

}  // namespace catena::ranks
