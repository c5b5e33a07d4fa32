#pragma once
#include <cstdint>

#include "catena/core/chain/chain.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/reference/answer.h"

namespace catena::reference {

/// The exact answer for a chain in a space that a box repeats: i and j collide when they are no neighbours
/// and i overlaps or touches some image of j (see Periodic). Shares no arithmetic with core/, only the value
/// types. Pairs are kept up to the limit; beyond, counts alone. O(n) where spheres are spread and each edge
/// repeats, O(n^2) at most. Throws InputError for a box that check_box refuses, and a sphere more than 2^20
/// boxes away.
Answer find_in_box(const Chain& chain, const PeriodicBox& box, std::uint64_t pair_limit);

}  // namespace catena::reference
