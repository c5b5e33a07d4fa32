#include "catena/core/blocks/block_layout.h"

#include <algorithm>
#include <cmath>

namespace catena {
namespace {

constexpr std::uint32_t block = BlockTree::block;

void make_room(BlockTree& tree) {
  constexpr std::uint32_t group = BlockTree::group;
  const auto groups = [](std::uint32_t count) { return count / group + (count % group != 0); };
  tree.capsules.resize(std::size_t{groups(tree.blocks)} * group * BlockTree::capsule_fields);
  tree.ordered.assign(groups(tree.blocks), 0);
  std::size_t l = 0;
  for (std::uint32_t count = groups(tree.blocks); count > 0; count = count > 1 ? groups(count) : 0, ++l) {
    if (l == tree.level.size()) tree.level.emplace_back();
    tree.level[l].count = count;
    tree.level[l].oriented.resize(std::size_t{groups(count)} * group * BlockTree::oriented_fields);
    tree.level[l].in_a_row.resize(groups(count));
    tree.level[l].with_the_next.resize(groups(count));
  }
  tree.level.resize(l);
}

}  // namespace

CopiedBlocks::CopiedBlocks(const ChainView& chain, BlockTree& tree, std::uint32_t count)
    : chain_(chain), tree_(tree), first_(tree.first.size()), copy_(tree.copies.size()) {
  tree.first.resize(first_ + count);
  tree.copies.resize(copy_ + std::size_t{count} * block);
  tree.copied_from.resize(tree.copies.size());
}

void CopiedBlocks::fill(std::uint32_t k, std::uint32_t begin, std::uint32_t size) {
  const std::size_t to = copy_ + std::size_t{k} * block;
  tree_.first[first_ + k] = BlockTree::copied | static_cast<std::uint32_t>(to);
  for (std::uint32_t s = 0; s < block; ++s) {
    tree_.copies[to + s] = chain_.spheres[begin + std::min(s, size - 1)];
    tree_.copied_from[to + s] = s < size ? begin + s : BlockTree::no_sphere;
  }
}

float block_scale(const Extent& extent) {
  const float greatest = std::max(extent.greatest_coordinate, extent.greatest_radius);
  if (greatest == 0) return 1;
  return std::ldexp(1.0f, std::clamp(19 - std::ilogb(greatest), -126, 127));
}

std::uint32_t count_blocks(const ChainView& chain) {
  const auto blocks = [](std::uint32_t spheres) { return spheres / block + (spheres % block != 0); };
  if (chain.strand_count == 1) return blocks(chain.size);
  std::uint32_t count = 0;
  const std::uint32_t* const first = chain.exclusion.strand_first;
  for (std::uint32_t s = 0; s < chain.strand_count; ++s) count += blocks(first[s + 1] - first[s]);
  return count;
}

void lay_out_blocks(const ChainView& chain, BlockTree& tree) {
  tree.scale = block_scale(chain.extent);
  tree.first.clear(), tree.copies.clear(), tree.copied_from.clear();
  for (std::uint32_t s = 0; s < chain.strand_count; ++s) {
    const bool one = chain.strand_count == 1;
    std::uint32_t at = one ? 0 : chain.exclusion.strand_first[s];
    const std::uint32_t end = one ? chain.size : chain.exclusion.strand_first[s + 1];
    const std::uint32_t full = (end - at) / block;
    const std::size_t begin = tree.first.size();
    tree.first.resize(begin + full);
    for (std::uint32_t k = 0; k < full; ++k, at += block) tree.first[begin + k] = at;
    if (at < end) CopiedBlocks(chain, tree, 1).fill(0, at, end - at);
  }
  tree.blocks = static_cast<std::uint32_t>(tree.first.size());
  make_room(tree);
}

}  // namespace catena
