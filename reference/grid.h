#pragma once
#include <functional>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"
#include "catena/reference/answer.h"

namespace catena::reference {

/// The answer of all_pairs by a hashed grid with one level for each octave of the radii. Want::any is
/// answered like Want::counts. For radii of one octave O(n + pairs) expected; each further octave that occurs
/// costs up to 27 look-ups a sphere. Any finite chain: zero radii, mixed scales, subnormals, coordinates
/// where a cell is absorbed by rounding. Throws PairLimitExceeded with the true number.
Answer by_grid(const Chain& chain, const Request& request = {});

/// A pair that is no neighbour, whether it collides, and its margin.
using NearVisitor = std::function<void(const Pair&, bool collides, double margin)>;

/// Every pair that collides or has a margin below 1 (a distance below sqrt 2 times the sum of the radii),
/// each once, in no order: all that a small change could flip. Margins below 2^-8 are margin() itself, and
/// it is margin() that is compared with 1; those between are told to a relative 2^-39. Cost as of by_grid, with eight times as many spheres in a cell.
void near_pairs(const Chain& chain, const NearVisitor& visit);

}  // namespace catena::reference
