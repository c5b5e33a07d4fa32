#pragma once
#include <type_traits>

#include "catena/core/cells/compare_blocks.h"
#include "catena/core/cells/compare_in_tree.h"
#include "catena/core/cells/host_warp.h"

namespace catena {

/// use(own_units), as a type, as these blocks have it.
template <class Use>
void with_own_units(const CapsuleBlocks& blocks, const Use& use) {
  blocks.own_units ? use(std::true_type()) : use(std::false_type());
}

/// Compares the spheres of blocks that met, block after block.
template <class Tests, class Sink>
void compare_blocks(const ChainView& chain, const CapsuleBlocks& blocks, Sink& sink) {
  with_own_units(blocks, [&](auto own_units) {
    const HostWarp warp;
    const BlockComparison<HostWarp, own_units.value> comparison(warp, chain, blocks);
    for (std::uint32_t b = 0; !blocks.all_crowded && b < blocks.blocks && !sink.satisfied(); ++b)
      comparison.plan(b, [&](auto work) { comparison.template compare<Tests>(b, work, sink); });
  });
}

/// The same of all blocks that their tree says may meet.
template <class Tests, class Sink>
void compare_blocks_in_tree(const ChainView& chain, const BlockNodes& nodes, const CapsuleBlocks& blocks,
                            Sink& sink) {
  with_own_units(blocks, [&](auto own_units) {
    const HostWarp warp;
    using Comparison = TreeComparison<HostWarp, own_units.value>;
    const Comparison comparison(warp, chain, nodes, blocks);
    for (std::uint32_t b = 0; b < blocks.blocks && !sink.satisfied(); b += Comparison::together)
      comparison.template compare<Tests>(b, sink);
  });
}

}  // namespace catena
