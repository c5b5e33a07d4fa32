// From a chain to blocks, their capsules, and nodes of sixteen blocks.
#if defined(CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H
#undef CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H
#else
#define CATENA_CORE_BLOCKS_BUILD_BLOCKS_INL_H
#endif

#include "catena/core/blocks/consecutive_blocks-inl.h"
#include "catena/core/blocks/ordered-inl.h"
#include "catena/core/prefetch.h"

HWY_BEFORE_NAMESPACE();
namespace catena::HWY_NAMESPACE {

/// Spheres that come from memory one after the other are waited for: the machine foresees no sixteen rows
/// that are read side by side.
HWY_INLINE void fetch_group(const ChainView& chain, const BlockTree& tree, std::uint32_t g) {
  constexpr std::size_t spheres = std::size_t{BlockTree::group} * BlockTree::block, line = 64;
  const std::uint32_t begin = tree.first[g * BlockTree::group] & ~BlockTree::unfilled;
  const char* const from = reinterpret_cast<const char*>(tree.spheres(chain) + begin);
  for (std::size_t k = 0; k < spheres * sizeof(Sphere); k += line) prefetch(from + k);
}

/// Fills the capsules and order of group g, whose blocks are laid out.
HWY_INLINE void build_group(const ChainView& chain, BlockTree& tree, std::uint32_t g) {
  constexpr std::uint32_t group = BlockTree::group, block = BlockTree::block;
  const std::uint32_t begin = g * group;
  Sphere copy[(group + 1) * block];
  const Sphere* const spheres = consecutive_blocks(chain, tree, g, copy);
  const bool in_one_run = spheres != copy;
  BlockSpheres own;
  load(spheres, Lanes16::all(tree.unit()), own);
  Lanes16 reach;
  Capsules capsules = capsules_around(own, reach);
  capsules.store(tree.capsules_of(g));
  std::uint32_t ordered = ordered_windows(own, capsules.centre, reach, spheres + group * block, tree.unit());
  if (!in_one_run || chain.strand_count > 1) {
    for (std::uint32_t k = 0; k < group; ++k) {
      const std::uint32_t b = begin + k;
      const bool joined = b + 1 < tree.blocks && !(tree.first[b] & BlockTree::unfilled) &&
                          tree.first[b + 1] == tree.first[b] + block &&
                          (chain.strand_count == 1 || chain.exclusion.strand_of[tree.first[b]] ==
                                                          chain.exclusion.strand_of[tree.first[b + 1]]);
      if (!joined) ordered &= ~(1u << k);
    }
  }
  tree.ordered[g] = static_cast<std::uint16_t>(ordered);
}

}  // namespace catena::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
