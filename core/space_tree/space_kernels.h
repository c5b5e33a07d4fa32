#pragma once
#include <span>

#include "catena/core/blocks/block_queues.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/space_tree/search_cost.h"
#include "catena/core/space_tree/space_evidence.h"
#include "catena/core/space_tree/space_queue.h"
#include "catena/core/space_tree/space_tree.h"

namespace catena {

/// The blocks of all crowded nodes in the order of space, and which of them are dense: so many others are
/// near them that spheres are better searched one by one. Tells `crowding`, and lays parts of blocks out
/// behind the tree's own. Where all are, or the chain jumps everywhere, `space` is empty. A block may cost
/// what a search by spheres would of its own, single.ns each, 0 or more. As many queues as the team has
/// members. O(n log n), of blocks; does not allocate when the crowd has not grown, in a team of one.
CATENA_API void build_space_tree(const ChainView& chain, BlockTree& tree, Crowding& crowding,
                                 SpaceTree& space, const SingleSpheres& single, std::span<SpaceQueue> queues,
                                 const Team& team, SpaceSort sort = SpaceSort::anew);

/// Reports every colliding pair of spheres in crowded nodes to the collector, once, but for those of two
/// dense blocks, of one block, and of two that follow one another. As many lanes and queues as the team has
/// members.
CATENA_API void search_space_tree(const ChainView& chain, const BlockTree& tree, const SpaceTree& space,
                                  std::span<SpaceQueue> entry_queues, std::span<BlockQueues> block_queues,
                                  PairCollector& collector, const Team& team);

/// The same to the lane, by the caller alone, slower, and tells `evidence` of all those pairs, and of which
/// it left to the search along the chain.
CATENA_API void search_space_tree(const ChainView& chain, const BlockTree& tree, const SpaceTree& space,
                                  SpaceQueue& entry_queue, BlockQueues& block_queues,
                                  PairCollector::Lane& lane, SpaceEvidence& evidence);

}  // namespace catena
