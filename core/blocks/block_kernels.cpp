// Compiled once for each instruction set; the best that the machine has is chosen at the first call.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "catena/core/blocks/block_kernels.cpp"
#include "catena/core/blocks/simd_targets.h"
#include "hwy/foreach_target.h"
// After foreach_target.h:
#include "catena/core/blocks/block_kernels.h"
#include "catena/core/blocks/block_layout.h"
#include "catena/core/blocks/build_tree-inl.h"
#include "catena/core/blocks/search_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

void build_here(const ChainView& chain, BlockTree& tree) {
  for (std::uint32_t g = 0; g * BlockTree::group < tree.blocks; ++g) build_group(chain, tree, g);
  for (std::size_t l = 0; l < tree.level.size(); ++l) build_level(tree, l);
}

void find_crowds_here(const BlockTree& tree, Crowding& crowding) {
  if (tree.blocks > 0) NodeWalk(tree, crowding, NoBlockEvidence{}).run();
}

void search_uncrowded_here(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                           BlockQueues& queues, PairCollector::Lane& lane) {
  BlockSearch<NoBlockEvidence>(chain, tree, queues, lane, {}).run(crowding);
}

void search_here(const ChainView& chain, const BlockTree& tree, BlockQueues& queues,
                 PairCollector::Lane& lane, const BlockEvidence* evidence) {
  if (evidence != nullptr)
    BlockSearch<BlockEvidence>(chain, tree, queues, lane, *evidence).run();
  else
    BlockSearch<NoBlockEvidence>(chain, tree, queues, lane, {}).run();
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace catena {

HWY_EXPORT(build_here);
HWY_EXPORT(find_crowds_here);
HWY_EXPORT(search_uncrowded_here);
HWY_EXPORT(search_here);

void build_block_tree(const ChainView& chain, BlockTree& tree) {
  lay_out_blocks(chain, tree);
  HWY_DYNAMIC_DISPATCH(build_here)(chain, tree);
}
void find_crowds(const BlockTree& tree, std::uint32_t limit, Crowding& crowding) {
  crowding.reset(tree, limit);
  HWY_DYNAMIC_DISPATCH(find_crowds_here)(tree, crowding);
}
void search_uncrowded(const ChainView& chain, const BlockTree& tree, const Crowding& crowding,
                      BlockQueues& queues, PairCollector::Lane& lane) {
  HWY_DYNAMIC_DISPATCH(search_uncrowded_here)(chain, tree, crowding, queues, lane);
}
void search_blocks(const ChainView& chain, const BlockTree& tree, BlockQueues& queues,
                   PairCollector::Lane& lane, const BlockEvidence* evidence) {
  HWY_DYNAMIC_DISPATCH(search_here)(chain, tree, queues, lane, evidence);
}

}  // namespace catena
#endif
