#pragma once
#include <cstdint>

#include "catena/core/chain/chain.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/reference/answer.h"
#include "catena/reference/grid.h"

namespace catena::reference {

/// The exact answer for a chain in a space that a box repeats: i and j collide when they are no neighbours
/// and i overlaps or touches some image of j (see Periodic). Shares no arithmetic with core/, only the value
/// types. Pairs are kept up to the limit; beyond, counts alone. O(n) where spheres are spread and each edge
/// repeats, O(n^2) at most. Throws InputError for a box that check_box refuses, and a sphere more than 2^20
/// boxes away.
Answer find_in_box(const Chain& chain, const PeriodicBox& box, std::uint64_t pair_limit);

/// The exact answer in that box, or in open space where it is null; pairs up to the limit of a usual request.
Answer find_in(const Chain& chain, const PeriodicBox* box);

/// As near_pairs: every pair that collides or has a margin below 1, each once, i < j, in no order; the margin
/// is that of the image of j that is nearest to i. Margins below 2^-8 are exact but for one rounding, those
/// above are told to a relative 2^-30, and what is compared with 1 is exact. Throws as find_in_box; its cost,
/// with more spheres in a cell.
void near_pairs_in_box(const Chain& chain, const PeriodicBox& box, const NearVisitor& visit);

}  // namespace catena::reference
