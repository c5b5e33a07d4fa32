// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/grid/grid_kernels.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include "catena/core/grid/centre_box-inl.h"
#include "catena/core/grid/form_levels-inl.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/grid/grid_parts.h"
#include "catena/core/grid/search_grid-inl.h"
#include "catena/core/grid/sort_spheres-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

void build_grid_here(const ChainView& chain, SphereGrid& grid, std::span<const std::uint32_t> only,
                     const Team& team) {
  // Of a chain whose extent is not known the greatest is 0.
  grid.equal_radii = !grid.each_radius && chain.extent.greatest_radius > 0 &&
                     chain.extent.least_radius == chain.extent.greatest_radius;
  const CentreBox box = box_of_centres(chain, team);
  sort_by_octave(chain, only, grid, team);
  LevelForming(chain, only, box, grid, team).form();
  for (SphereGrid::Level& level : grid.levels) SphereSort(chain, grid, team).sort(level);
}

void search_grid_here(const ChainView& chain, const SphereGrid& grid, std::size_t l, std::uint32_t begin,
                      std::uint32_t end, bool across, GridQueues& queues, PairCollector::Lane& lane,
                      GridEvidence* evidence) {
  const auto run = [&](auto& sink) {
    GridSearch search(chain, grid, queues, lane, sink);
    across ? search.across(l, begin, end) : search.within(l, begin, end);
  };
  NoGridEvidence nothing;
  evidence != nullptr ? run(*evidence) : run(nothing);
}

std::uint32_t spheres_of_a_vector_here() { return sphere_lanes; }

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(build_grid_here);
HWY_EXPORT(search_grid_here);
HWY_EXPORT(spheres_of_a_vector_here);

void build_grid(const ChainView& chain, SphereGrid& grid, std::span<const std::uint32_t> only,
                const Team& team) {
  HWY_DYNAMIC_DISPATCH(build_grid_here)(chain, grid, only, team);
}

void search_grid(const ChainView& chain, const SphereGrid& grid, std::span<GridQueues> queues,
                 PairCollector& collector, const Team& team) {
  for_each_part(grid, team, [&](std::size_t l, std::uint32_t begin, std::uint32_t end, bool across) {
    const unsigned member = team.member();
    HWY_DYNAMIC_DISPATCH(search_grid_here)
    (chain, grid, l, begin, end, across, queues[member], collector.lane(member), nullptr);
  });
}
void search_grid(const ChainView& chain, const SphereGrid& grid, GridQueues& queues,
                 PairCollector::Lane& lane, GridEvidence& evidence) {
  for_each_part(grid, Team(), [&](std::size_t l, std::uint32_t begin, std::uint32_t end, bool across) {
    HWY_DYNAMIC_DISPATCH(search_grid_here)(chain, grid, l, begin, end, across, queues, lane, &evidence);
  });
  evidence.rest();
}

std::uint32_t spheres_of_a_vector() { return HWY_DYNAMIC_DISPATCH(spheres_of_a_vector_here)(); }

}  // namespace catena
#endif
