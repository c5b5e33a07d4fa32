#pragma once
#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/parts/local_chain.h"

namespace catena::parts {

/// A copy of a part and its halo that stands alone, for searches that take chains. O(size).
CATENA_API Chain part_as_chain(const Chain& whole, const LocalChain& part);

}  // namespace catena::parts
