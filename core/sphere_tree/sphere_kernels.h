#pragma once
#include <span>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/sphere_tree/sphere_evidence.h"
#include "catena/core/sphere_tree/sphere_queues.h"
#include "catena/core/sphere_tree/sphere_tree.h"

namespace catena {

/// Sorts the spheres of a chain, or `only` those of these ascending indices where it is not empty, and
/// encloses them in nodes. O(n log n), and O(n) where they need not be sorted anew; does not allocate when n
/// has not grown, in a team of one.
CATENA_API void build_sphere_tree(const ChainView& chain, SphereTree& tree,
                                  std::span<const std::uint32_t> only, const Team& team,
                                  SpaceSort sort = SpaceSort::anew);

/// Reports every colliding pair of the tree's spheres to the collector, once. As many lanes and queues as the
/// team has members.
CATENA_API void search_sphere_tree(const ChainView& chain, const SphereTree& tree,
                                   std::span<SphereQueues> queues, PairCollector& collector,
                                   const Team& team);

/// The same to the lane, by the caller alone, slower, and tells `evidence` of all pairs of those spheres.
CATENA_API void search_sphere_tree(const ChainView& chain, const SphereTree& tree, SphereQueues& queues,
                                   PairCollector::Lane& lane, const SphereEvidence& evidence);

}  // namespace catena
