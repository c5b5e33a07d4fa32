// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/space_tree/space_kernels.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include "catena/core/space_tree/build_space_tree-inl.h"
#include "catena/core/space_tree/judge_density-inl.h"
#include "catena/core/space_tree/search_space_tree-inl.h"
#include "catena/core/space_tree/space_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

void build_space_tree_here(const ChainView& chain, BlockTree& tree, Crowding& crowding, SpaceTree& space,
                           const SingleSpheres& single, std::span<SpaceQueue> queues, const Team& team,
                           SpaceSort sort) {
  space.entries = 0;
  // Short strands leave blocks unfilled.
  const double of_a_block = static_cast<double>(chain.size) / tree.blocks, block_ns = single.ns * of_a_block,
               pairs = single.pairs * of_a_block;
  if (mostly_dense(chain, tree, crowding, block_ns, pairs)) return;
  SpaceBuild build(chain, tree, crowding, space, team);
  if (!build.collect()) return;
  build.build(sort);
  judge_density(chain, tree, space, crowding, queues, block_ns, pairs, team);
}

void search_space_tree_here(const ChainView& chain, const BlockTree& tree, const SpaceTree& space,
                            std::uint32_t begin, std::uint32_t end, SpaceQueue& entry_queue,
                            BlockQueues& block_queues, PairCollector::Lane& lane, SpaceEvidence* evidence) {
  const auto run = [&](auto& sink) {
    SpaceSearch search(chain, tree, space, block_queues, lane, sink);
    SpaceWalk walk(space, entry_queue, search, sink);
    for (std::uint32_t a = begin; a < end && !lane.satisfied(); ++a) walk.node(a, false);
    walk.finish();
    search.finish();
  };
  const NoSpaceEvidence nothing;
  evidence != nullptr ? run(*evidence) : run(nothing);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(build_space_tree_here);
HWY_EXPORT(search_space_tree_here);

void build_space_tree(const ChainView& chain, BlockTree& tree, Crowding& crowding, SpaceTree& space,
                      const SingleSpheres& single, std::span<SpaceQueue> queues, const Team& team,
                      SpaceSort sort) {
  HWY_DYNAMIC_DISPATCH(build_space_tree_here)(chain, tree, crowding, space, single, queues, team, sort);
}

void search_space_tree(const ChainView& chain, const BlockTree& tree, const SpaceTree& space,
                       std::span<SpaceQueue> entry_queues, std::span<BlockQueues> block_queues,
                       PairCollector& collector, const Team& team) {
  constexpr std::uint32_t nodes_of_a_task = 16;
  team.for_each_range(space.nodes(), nodes_of_a_task, [&](std::uint32_t begin, std::uint32_t end) {
    const unsigned member = team.member();
    HWY_DYNAMIC_DISPATCH(search_space_tree_here)
    (chain, tree, space, begin, end, entry_queues[member], block_queues[member], collector.lane(member),
     nullptr);
  });
}
void search_space_tree(const ChainView& chain, const BlockTree& tree, const SpaceTree& space,
                       SpaceQueue& entry_queue, BlockQueues& block_queues, PairCollector::Lane& lane,
                       SpaceEvidence& evidence) {
  HWY_DYNAMIC_DISPATCH(search_space_tree_here)
  (chain, tree, space, 0, space.nodes(), entry_queue, block_queues, lane, &evidence);
}

}  // namespace catena
#endif
