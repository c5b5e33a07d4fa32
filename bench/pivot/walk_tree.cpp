// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/bench/pivot/walk_tree.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include "catena/bench/pivot/walk_search-inl.h"
#include "catena/bench/pivot/walk_tree.h"

HWY_BEFORE_NAMESPACE();
namespace catena::bench::HWY_NAMESPACE {

bool attempt_one_here(WalkTree& tree, const Pivot& pivot) { return WalkSearch(tree).attempt(pivot); }
bool attempt_all_here(WalkTree& tree, std::span<const Pivot> pivots) {
  return WalkSearch(tree).attempt(pivots);
}

}  // namespace catena::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena::bench {

HWY_EXPORT(attempt_one_here);
HWY_EXPORT(attempt_all_here);

bool attempt(WalkTree& tree, const Pivot& pivot) {
  return HWY_DYNAMIC_DISPATCH(attempt_one_here)(tree, pivot);
}
bool attempt(WalkTree& tree, std::span<const Pivot> pivots) {
  return HWY_DYNAMIC_DISPATCH(attempt_all_here)(tree, pivots);
}

}  // namespace catena::bench
#endif
