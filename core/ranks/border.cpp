#include "catena/core/ranks/border.h"

#include <algorithm>

#include "catena/core/hierarchy/morton_grid.h"

namespace catena::ranks {
namespace {

/// So many blocks in one box are looked at before each is.
constexpr std::uint32_t stretch = 8;

bool meets(const ForeignTops& tops, const Box& box) {
  bool meets = false;
  tops.for_each_rank(box, [&](unsigned) { meets = true; });
  return meets;
}

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
      if (!meets(tops, around)) continue;
      for (std::uint32_t k = 0; k < near.size(); ++k) {
        const std::uint32_t done = (b + k) * Block::most;
        if (meets(tops, near[k])) blocks_.push_back({p, begin + done, std::min(Block::most, size - done)});
      }
    }
    first += blocks;
  }
  const std::span<const Sphere> spheres = part.chain().spheres();
  struct Keyed {
    std::uint64_t code;
    Block block;
  };
  CentreCorners corners;
  for (const Block& block : blocks_) corners.take(middle_of(spheres, block));
  const MortonGrid grid(corners);
  std::vector<Keyed> keyed;
  keyed.reserve(blocks_.size());
  for (const Block& block : blocks_) keyed.push_back({grid.code(middle_of(spheres, block)), block});
  std::ranges::stable_sort(keyed, {}, &Keyed::code);
  std::ranges::transform(keyed, blocks_.begin(), &Keyed::block);
}

}  // namespace catena::ranks
