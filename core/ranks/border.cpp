#include "catena/core/ranks/border.h"

#include <algorithm>
#include <type_traits>

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
    const Box box = boxes[box_at_[b]];
    boxes_.set(b, box);
    foreign.for_each_rank(box, [&](unsigned rank) { near_[rank].push_back(b); });
  }
  boxes_.refresh(0, blocks);
  std::vector<std::uint32_t>().swap(box_at_);
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
        if (!tops.meet(near[k])) continue;
        blocks_.push_back({p, begin + done, std::min(Block::most, size - done)});
        box_at_.push_back(static_cast<std::uint32_t>(first + b + k));
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
  const auto sort_alike = [&](auto& values) {
    std::remove_reference_t<decltype(values)> sorted;
    sorted.reserve(values.size());
    for (const std::uint64_t key : keys) sorted.push_back(values[static_cast<std::uint32_t>(key)]);
    values = std::move(sorted);
  };
  sort_alike(blocks_);
  sort_alike(box_at_);
}

}  // namespace catena::ranks
