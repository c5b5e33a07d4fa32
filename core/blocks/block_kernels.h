#pragma once
#include <span>

#include "catena/core/blocks/block_evidence.h"
#include "catena/core/blocks/block_queues.h"
#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"

namespace catena {

/// The tree over a chain. O(n); does not allocate when n has not grown, in a team of one.
CATENA_API void build_block_tree(const ChainView& chain, BlockTree& tree, const Team& team);

/// Fills `crowding` with the pairs of nodes that met, but for those of two nodes that had met more than
/// `limit` others before, or twice as many where there are few nodes and a look at some says that to go on in
/// the chain's order costs least. O(limit * nodes) but for tests in upper levels.
CATENA_API void find_crowds(const ChainView& chain, const BlockTree& tree, std::uint32_t limit,
                            Crowding& crowding, const Team& team);

/// Reports every colliding pair to the collector, once, but for those of spheres that are both in crowded
/// nodes. As many lanes and queues as the team has members.
CATENA_API void search_uncrowded(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                                 std::span<BlockQueues> queues, PairCollector& collector, const Team& team);

/// The same to the lane, by the caller alone, slower. Tells `evidence` of all pairs but those of two crowded
/// nodes; and of these, what it finds in and between blocks that follow one another.
CATENA_API void search_uncrowded(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                                 BlockQueues& queues, PairCollector::Lane& lane,
                                 const BlockEvidence& evidence);

/// Reports every colliding pair to the lane, once. `evidence` may be null; with it the search is slower.
CATENA_API void search_blocks(const ChainView& chain, const BlockTree& tree, BlockQueues& queues,
                              PairCollector::Lane& lane, const BlockEvidence* evidence);

}  // namespace catena
