#pragma once
#include "catena/core/strategy/request.h"

namespace catena::properties {

/// Of all pairs of a chain, and their counts, leaves what was asked for; throws PairLimitExceeded as a search
/// does.
void leave_what_was_asked(const Request& request, Collisions& result);

}  // namespace catena::properties
