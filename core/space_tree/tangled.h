#pragma once
#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"

namespace catena {

/// Stretches of 128 spheres of the chain meet more others than those next to them than a tree in the chain's
/// order bears, on average; told by as many as need be to see some meet, the square root of all, and each by
/// some spheres. O(sqrt(n)).
CATENA_API bool tangled(const ChainView& chain);

}  // namespace catena
