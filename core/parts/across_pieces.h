#pragma once
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/pair.h"
#include "catena/core/parts/local_chain.h"

namespace catena::parts {

/// Neighbours of the whole chain that overlap, and whose spheres are in several pieces, or around the end of
/// a closed strand that is not here whole, in the numbers of the pieces: i < j, each once, sorted. O(p log p
/// + e log p) for p pieces and e pairs of neighbours across the end of one, or extra pairs that begin in one;
/// under an arc window O(log n) more for each of n spheres that the greatest radius reaches from such an end.
std::vector<Pair> neighbours_across(const Chain& whole, std::span<const LocalChain::Piece> pieces);

}  // namespace catena::parts
