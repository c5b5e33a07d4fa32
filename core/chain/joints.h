#pragma once
#include <span>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"

namespace catena {

/// The neighbours that joints make, as sorted unique pairs i < j for Exclusion::extra_pairs. The tube is a
/// graph: its edges are the steps along the strands (around, when closed) and the joints, between strands or
/// from a strand back onto itself. With an index window k these are the pairs at most k edges apart that are
/// not so along one strand, so the joints themselves for k = 1; with an arc window f, those nearer along the
/// edges than f * (ri + rj), an edge being as long as its centres are apart, and nearer than along one
/// strand.
///
/// `joints` name spheres of the given ones; the strands are those of a valid chain. Throws InputError when a
/// joint names no sphere, or one sphere twice.
///
/// Cost: O(n log n), and for each sphere that a joint can concern O(m log m), m spheres lying within its
/// reach: k edges, or 2 * f * radius. The result can be that large, too: a window as long as the tube makes
/// all pairs.
CATENA_API std::vector<Pair> pairs_across_joints(std::span<const Sphere> spheres, const Strands& strands,
                                      std::span<const Pair> joints, const Exclusion& rule);

}  // namespace catena
