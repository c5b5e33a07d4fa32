#pragma once
#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"
#include "catena/reference/answer.h"

namespace catena::reference {

/// The answer of all_pairs by a hashed grid with one level for each octave of the radii. Want::any is
/// answered like Want::counts. For radii of one octave O(n + pairs) expected; each further octave that occurs
/// costs up to 27 look-ups a sphere. Any finite chain: zero radii, mixed scales, subnormals, coordinates
/// where a cell is absorbed by rounding. Throws PairLimitExceeded with the true number.
Answer by_grid(const Chain& chain, const Request& request = {});

}  // namespace catena::reference
