// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/grid/grid_kernels.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include "catena/core/grid/centre_box-inl.h"
#include "catena/core/grid/form_levels-inl.h"
#include "catena/core/grid/grid_kernels.h"
#include "catena/core/grid/search_grid-inl.h"
#include "catena/core/grid/sort_spheres-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

void build_grid_here(const ChainView& chain, SphereGrid& grid, std::span<const std::uint32_t> only) {
  const CentreBox box = box_of_centres(chain);
  sort_by_octave(chain, only, grid);
  LevelForming(chain, only, box, grid).form();
  for (const SphereGrid::Level& level : grid.levels) SphereSort(chain, grid).sort(level);
}

void search_grid_here(const ChainView& chain, const SphereGrid& grid, GridQueues& queues,
                      PairCollector::Lane& lane) {
  GridSearch(chain, grid, queues, lane).run();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(build_grid_here);
HWY_EXPORT(search_grid_here);

void build_grid(const ChainView& chain, SphereGrid& grid, std::span<const std::uint32_t> only) {
  HWY_DYNAMIC_DISPATCH(build_grid_here)(chain, grid, only);
}
void search_grid(const ChainView& chain, const SphereGrid& grid, GridQueues& queues,
                 PairCollector::Lane& lane) {
  HWY_DYNAMIC_DISPATCH(search_grid_here)(chain, grid, queues, lane);
}

}  // namespace catena
#endif
