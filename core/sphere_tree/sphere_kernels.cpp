// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/sphere_tree/sphere_kernels.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include "catena/core/sphere_tree/build_sphere_tree-inl.h"
#include "catena/core/sphere_tree/search_sphere_tree-inl.h"
#include "catena/core/sphere_tree/sphere_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

void build_sphere_tree_here(const ChainView& chain, SphereTree& tree, std::span<const std::uint32_t> only,
                            const Team& team, SpaceSort sort) {
  SphereBuild(chain, tree, team).run(only, sort);
}

void search_sphere_tree_here(const ChainView& chain, const SphereTree& tree, std::uint32_t begin,
                             std::uint32_t end, SphereQueues& queues, PairCollector::Lane& lane,
                             const SphereEvidence* evidence) {
  const auto run = [&](const auto& sink) { SphereSearch(chain, tree, queues, lane, sink).run(begin, end); };
  evidence != nullptr ? run(*evidence) : run(NoSphereEvidence{});
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(build_sphere_tree_here);
HWY_EXPORT(search_sphere_tree_here);

void build_sphere_tree(const ChainView& chain, SphereTree& tree, std::span<const std::uint32_t> only,
                       const Team& team, SpaceSort sort) {
  HWY_DYNAMIC_DISPATCH(build_sphere_tree_here)(chain, tree, only, team, sort);
}

void search_sphere_tree(const ChainView& chain, const SphereTree& tree, std::span<SphereQueues> queues,
                        PairCollector& collector, const Team& team) {
  constexpr std::uint32_t nodes_of_a_task = 32;
  team.for_each_range(tree.nodes(), nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
    const unsigned member = team.member();
    HWY_DYNAMIC_DISPATCH(search_sphere_tree_here)
    (chain, tree, begin, end, queues[member], collector.lane(member), nullptr);
  });
}
void search_sphere_tree(const ChainView& chain, const SphereTree& tree, SphereQueues& queues,
                        PairCollector::Lane& lane, const SphereEvidence& evidence) {
  HWY_DYNAMIC_DISPATCH(search_sphere_tree_here)(chain, tree, 0, tree.nodes(), queues, lane, &evidence);
}

}  // namespace catena
#endif
