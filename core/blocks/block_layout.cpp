#include "catena/core/blocks/block_layout.h"

#include <algorithm>
#include <cmath>

#include "catena/core/blocks/squares_in_range.h"

namespace catena {
namespace {

void make_room(BlockTree& tree, std::uint32_t blocks) {
  const auto groups = [](std::uint32_t count) {
    return count / BlockTree::group + (count % BlockTree::group != 0);
  };
  tree.capsules.resize(std::size_t{groups(blocks)} * BlockTree::group * BlockTree::capsule_fields);
  tree.ordered.assign(groups(blocks), 0);
  std::size_t l = 0;
  for (std::uint32_t count = groups(blocks); count > 0; count = count > 1 ? groups(count) : 0, ++l) {
    if (l == tree.level.size()) tree.level.emplace_back();
    tree.level[l].count = count;
    tree.level[l].oriented.resize(std::size_t{groups(count)} * BlockTree::group * BlockTree::oriented_fields);
    tree.level[l].in_a_row.resize(groups(count));
    tree.level[l].with_the_next.resize(groups(count));
  }
  tree.level.resize(l);
}

}  // namespace

void make_room_for_blocks(BlockTree& tree, std::uint32_t count) {
  tree.first.resize(count);
  tree.filled.resize(count);
}

void set_block(BlockTree& tree, std::uint32_t b, std::uint32_t begin, std::uint32_t size) {
  tree.first[b] = size < BlockTree::block ? begin | BlockTree::unfilled : begin;
  tree.filled[b] = static_cast<std::uint8_t>(size);
}

float block_scale(const Extent& extent) {
  const float greatest = std::max(extent.greatest_coordinate, extent.greatest_radius);
  if (greatest == 0) return 1;
  return std::ldexp(1.0f, std::clamp(19 - std::ilogb(greatest), -126, 127));
}

std::uint32_t count_blocks(const ChainView& chain) {
  const auto blocks = [](std::uint32_t spheres) {
    return spheres / BlockTree::block + (spheres % BlockTree::block != 0);
  };
  if (chain.strand_count == 1) return blocks(chain.size);
  std::uint32_t count = 0;
  const std::uint32_t* const first = chain.exclusion.strand_first;
  for (std::uint32_t s = 0; s < chain.strand_count; ++s) count += blocks(first[s + 1] - first[s]);
  return count;
}

bool blocks_half_empty(const ChainView& chain) {
  return chain.strand_count > 1 && std::uint64_t{count_blocks(chain)} * (BlockTree::block / 2) >= chain.size;
}

void lay_out_blocks(const ChainView& chain, BlockTree& tree) {
  tree.scale = block_scale(chain.extent);
  tree.blocks = 0;  // where there is no room for them, it is a tree of none
  const std::uint32_t blocks = count_blocks(chain);
  make_room_for_blocks(tree, blocks);
  make_room(tree, blocks);
  tree.scaled.resize(squares_in_range(chain.extent.greatest_radius) ? 0 : chain.size);
  std::uint32_t b = 0;
  for (std::uint32_t s = 0; s < chain.strand_count; ++s) {
    const bool one = chain.strand_count == 1;
    std::uint32_t at = one ? 0 : chain.exclusion.strand_first[s];
    const std::uint32_t end = one ? chain.size : chain.exclusion.strand_first[s + 1];
    const std::uint32_t full = (end - at) / BlockTree::block;
    for (std::uint32_t k = 0; k < full; ++k) tree.first[b + k] = at + k * BlockTree::block;
    b += full, at += full * BlockTree::block;
    if (at < end) set_block(tree, b++, at, end - at);
  }
  tree.blocks = blocks;
}

void fill_tail(const ChainView& chain, BlockTree& tree) {
  const Sphere* const spheres = tree.spheres(chain);
  for (std::uint32_t k = 0; k < 2 * BlockTree::block && chain.size > 0; ++k)
    tree.tail[k] = spheres[std::min(BlockTree::tail_first(chain.size) + k, chain.size - 1)];
}

}  // namespace catena
