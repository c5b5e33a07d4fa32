#pragma once
#include <cstdint>
#include <span>

#include "catena/core/executor/pair_collector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/grid/grid_evidence.h"
#include "catena/core/grid/grid_queues.h"
#include "catena/core/grid/sphere_grid.h"

namespace catena {

/// Lays the grid out and sorts the spheres, or `only` those of these ascending indices where it is not empty,
/// into it. O(n); does not allocate when neither n nor the number of levels has grown, in a team of one.
CATENA_API void build_grid(const ChainView& chain, SphereGrid& grid, std::span<const std::uint32_t> only,
                           const Team& team);

/// Reports every colliding pair of the spheres that the grid was built for to the collector, once. As many
/// lanes and queues as the team has members.
CATENA_API void search_grid(const ChainView& chain, const SphereGrid& grid, std::span<GridQueues> queues,
                            PairCollector& collector, const Team& team);

/// The same to the lane, by the caller alone, slower, and tells `evidence` of all pairs of those spheres.
CATENA_API void search_grid(const ChainView& chain, const SphereGrid& grid, GridQueues& queues,
                            PairCollector::Lane& lane, GridEvidence& evidence);

/// So many spheres a vector of these searches holds on this machine: 16 with AVX-512, 8 with AVX2, else 4
/// or 1.
CATENA_API std::uint32_t spheres_of_a_vector();
/// Whether these are AVX-512's.
inline bool wide_vectors() { return spheres_of_a_vector() == 16; }

}  // namespace catena
