#include "catena/core/ranks/border.h"

#include <algorithm>

#include "catena/core/hierarchy/morton_grid.h"

namespace catena::ranks {
namespace {

/// So many blocks in one box are looked at before each is.
constexpr std::uint32_t stretch = 8;

}  // namespace

Border::Border(const HeldPart& part, std::span<const Box> boxes, const Tops& tops, unsigned own)
    : own_(own), near_(tops.ranks()) {
  const ForeignTops foreign(tops, own);
  if (foreign.any()) gather(part, boxes, foreign);
  const auto blocks = static_cast<std::uint32_t>(blocks_.size());
  boxes_.clear(blocks);
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const Box box = box_around(part.spheres(blocks_[b]));
    boxes_.set(b, box);
    foreign.for_each_rank(box, [&](unsigned rank) { near_[rank].push_back(b); });
  }
  boxes_.refresh(0, blocks);
}

void Border::gather(const HeldPart& part, std::span<const Box> boxes, const ForeignTops& tops) {
  std::size_t first = 0;  // block of the piece
  for (std::uint32_t p = 0; p < part.pieces().size(); ++p) {
    const auto [id, begin, size, strand] = part.pieces()[p];
    const std::uint32_t blocks = (size + Block::most - 1) / Block::most;
    for (std::uint32_t b = 0; b < blocks; b += stretch) {
      const auto near = boxes.subspan(first + b, std::min(stretch, blocks - b));
      Box around = near[0];
      for (const Box& box : near.subspan(1)) around.join(box);
      if (!tops.meet(around)) continue;
      for (std::uint32_t k = 0; k < near.size(); ++k) {
        const std::uint32_t done = (b + k) * Block::most;
        if (tops.meet(near[k])) blocks_.push_back({p, begin + done, std::min(Block::most, size - done)});
      }
    }
    first += blocks;
  }
  sort_in_space(part.chain().spheres());
}

void Border::sort_in_space(std::span<const Sphere> spheres) {
  CentreCorners corners;
  for (const Block& block : blocks_) corners.take(middle_of(spheres, block));
  const MortonGrid grid(corners);
  std::vector<std::uint64_t> keys;  // the upper half of a code, and the number of a block
  keys.reserve(blocks_.size());
  for (std::uint64_t b = 0; b < blocks_.size(); ++b)
    keys.push_back(grid.code(middle_of(spheres, blocks_[b])) >> (3 * MortonGrid::bits - 32) << 32 | b);
  std::ranges::sort(keys);
  std::vector<Block> sorted;
  sorted.reserve(blocks_.size());
  for (const std::uint64_t key : keys) sorted.push_back(blocks_[static_cast<std::uint32_t>(key)]);
  blocks_ = std::move(sorted);
}

}  // namespace catena::ranks
