#pragma once
#include "catena/core/blocks/block_tree.h"
#include "catena/core/export.h"

namespace catena {

/// The power of two that brings the chain's greatest coordinate or radius to 2^19 .. 2^20, as far as binary32
/// holds it; 1 for a chain of zeros.
CATENA_API float block_scale(const Extent& extent);

/// The blocks that lay_out_blocks makes. O(strands).
std::uint32_t count_blocks(const ChainView& chain);
/// Strands are so short that these would be half empty, or more. O(strands).
bool blocks_half_empty(const ChainView& chain);

/// So many blocks, of the tree or behind its own, are to be set.
void make_room_for_blocks(BlockTree& tree, std::uint32_t count);
/// Block b has `size` consecutive spheres, 1 to 8. Several threads may set some.
void set_block(BlockTree& tree, std::uint32_t b, std::uint32_t begin, std::uint32_t size);

/// The tree's tail, once the spheres that it looks at are known.
void fill_tail(const ChainView& chain, BlockTree& tree);

/// Lays every strand out in blocks of eight consecutive spheres, and a last one of what is left. Sets scale,
/// blocks, first, filled; makes room for capsules, order and nodes, and for scaled spheres where these are
/// wanted. O(n / 8 + strands); does not allocate when n has not grown.
void lay_out_blocks(const ChainView& chain, BlockTree& tree);

}  // namespace catena
