#pragma once
#include "catena/core/chain/chain.h"
#include "catena/core/strategy/request.h"
#include "catena/reference/answer.h"

namespace catena::reference {

/// The exact answer for a chain: all pairs while that is quick, the grid otherwise. Shares no arithmetic with
/// core/. With Want::pairs sorted pairs and counts; otherwise counts only, which is what a flood of pairs
/// leaves room for. A million spheres with 5 pairs each take a few seconds. Throws PairLimitExceeded with the
/// true number.
Answer find(const Chain& chain, const Request& request = {});

}  // namespace catena::reference
