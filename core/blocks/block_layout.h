#pragma once
#include "catena/core/blocks/block_tree.h"

namespace catena {

/// The power of two that brings the chain's greatest coordinate or radius to 2^19 .. 2^20, as far as binary32
/// holds it; 1 for a chain of zeros.
float block_scale(const Extent& extent);

/// The blocks that lay_out_blocks makes. O(strands).
std::uint32_t count_blocks(const ChainView& chain);

/// More blocks behind a tree's, of copied spheres. Several threads may fill them.
class CopiedBlocks {
 public:
  CopiedBlocks(const ChainView& chain, BlockTree& tree, std::uint32_t count);
  /// The k-th of them, for `size` consecutive spheres, at most eight; filled up with copies of the last.
  void fill(std::uint32_t k, std::uint32_t begin, std::uint32_t size);

 private:
  const ChainView& chain_;
  BlockTree& tree_;
  const std::size_t first_, copy_;  // of the tree's blocks and copies
};

/// Lays every strand out in blocks of eight consecutive spheres, the last one copied where it is short. Sets
/// scale, blocks, first, copies; makes room for capsules, order and nodes. O(n); does not
/// allocate when n has not grown.
void lay_out_blocks(const ChainView& chain, BlockTree& tree);

}  // namespace catena
