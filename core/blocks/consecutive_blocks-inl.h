// Spheres of blocks, eight each, one block after another.
#if defined(CATENA_CORE_BLOCKS_CONSECUTIVE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_CONSECUTIVE_BLOCKS_INL_H
#undef CATENA_CORE_BLOCKS_CONSECUTIVE_BLOCKS_INL_H
#else
#define CATENA_CORE_BLOCKS_CONSECUTIVE_BLOCKS_INL_H
#endif

#include <cstring>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/simd_targets.h"
#include "catena/core/chain/chain_view.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// The spheres of a block; the last of one that is unfilled, repeated.
HWY_INLINE void copy_block(const ChainView& chain, const BlockTree& tree, std::uint32_t b, Sphere* to) {
  std::memcpy(to, tree.spheres(chain, b), sizeof(Sphere) * BlockTree::block);
  for (std::uint32_t k = tree.size_of(b); k < BlockTree::block; ++k) to[k] = to[k - 1];
}

/// The spheres of the sixteen blocks of node g, and of the next one, block after block; in the chain itself
/// where they lie there so, else in `copy`. Past the tree's last block that one is repeated.
HWY_INLINE const Sphere* consecutive_blocks(const ChainView& chain, const BlockTree& tree, std::uint32_t g,
                                            Sphere* copy) {
  constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block;
  const std::uint32_t begin = g * group, next = begin + group;
  // The next is filled then, as its bit is not set; and all before it are, as they end there.
  if (next < tree.blocks && !(tree.first[begin] & BlockTree::unfilled) &&
      tree.first[next] == tree.first[begin] + group * block)
    return tree.spheres(chain) + tree.first[begin];
  for (std::uint32_t k = 0; k <= group; ++k)
    copy_block(chain, tree, begin + k < tree.blocks ? begin + k : tree.blocks - 1, copy + k * block);
  return copy;
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
