#pragma once
#include <optional>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"

namespace catena::reference {

/// Why FCL cannot be asked here; nullopt when it can.
std::optional<std::string> fcl_unavailable();

/// The collisions that FCL, the Flexible Collision Library, finds in binary64: fcl::Sphere<double> in a
/// DynamicAABBTreeCollisionManager, neighbours left out by the chain's rule. A peer to compare with, not a
/// reference: it compares |cA - cB| with rA + rB, both rounded, and boxes with rounded faces, so a pair
/// within some 2^-50 of touching may go either way. It digests every valid chain: no binary32 number can
/// overflow or underflow in it. Answers as the request wants (any like counts), pairs sorted; O(n log n +
/// pairs) expected. Throws CapacityError when FCL is not built in, PairLimitExceeded past the request's
/// limit.
Collisions fcl_collisions(const Chain& chain, const Request& request = {});

}  // namespace catena::reference
