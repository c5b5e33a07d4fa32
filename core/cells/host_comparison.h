#pragma once
#include <type_traits>

#include "catena/core/cells/compare_blocks.h"
#include "catena/core/cells/compare_in_tree.h"
#include "catena/core/cells/host_warp.h"

namespace catena {

/// Compares the spheres of blocks that met, block after block.
template <class Tests, class Sink>
void compare_blocks(const ChainView& chain, const CapsuleBlocks& blocks, Sink& sink) {
  const auto compare = [&](auto own_units) {
    const HostWarp warp;
    const BlockComparison<HostWarp, own_units.value> comparison(warp, chain, blocks);
    for (std::uint32_t b = 0; !blocks.all_crowded && b < blocks.blocks && !sink.satisfied(); ++b)
      comparison.plan(b, [&](auto work) { comparison.template compare<Tests>(b, work, sink); });
  };
  blocks.own_units ? compare(std::true_type()) : compare(std::false_type());
}

/// The same of all blocks that their tree says may meet.
template <class Tests, class Sink>
void compare_blocks_in_tree(const ChainView& chain, const BlockNodes& nodes, const CapsuleBlocks& blocks,
                            Sink& sink) {
  const auto compare = [&](auto own_units) {
    const HostWarp warp;
    using Comparison = TreeComparison<HostWarp, own_units.value>;
    const Comparison comparison(warp, chain, nodes, blocks);
    for (std::uint32_t b = 0; b < blocks.blocks && !sink.satisfied(); b += Comparison::together)
      comparison.template compare<Tests>(b, sink);
  };
  blocks.own_units ? compare(std::true_type()) : compare(std::false_type());
}

}  // namespace catena
