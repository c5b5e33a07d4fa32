#pragma once
#include <span>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/grid/grid_queues.h"
#include "catena/core/grid/sphere_grid.h"

namespace catena {

/// Lays the grid out and sorts the spheres, or `only` those of these ascending indices, into it. O(n); does not allocate when neither n nor the number of
/// levels has grown.
void build_grid(const ChainView& chain, SphereGrid& grid, std::span<const std::uint32_t> only = {});

/// Reports every colliding pair of the chain that the grid was built for to the lane, once.
void search_grid(const ChainView& chain, const SphereGrid& grid, GridQueues& queues,
                 PairCollector::Lane& lane);

}  // namespace catena
