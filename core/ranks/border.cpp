#include "catena/core/ranks/border.h"

#include <algorithm>

#include "catena/core/hierarchy/morton_grid.h"

namespace catena::ranks {
namespace {

/// So many spheres in one box are looked at before their blocks are.
constexpr std::uint32_t stretch = 8 * Block::most;

bool meets(const ForeignTops& tops, const Box& box) {
  bool meets = false;
  tops.for_each_rank(box, [&](unsigned) { meets = true; });
  return meets;
}

}  // namespace

Border::Border(const HeldPart& part, const Tops& tops, unsigned ranks, unsigned own) : near_(ranks) {
  const ForeignTops foreign(tops, own);
  if (foreign.any()) gather(part, foreign);
  const auto blocks = static_cast<std::uint32_t>(blocks_.size());
  boxes_.clear(blocks);
  for (std::uint32_t b = 0; b < blocks; ++b) {
    const Box box = box_around(part.spheres(blocks_[b]));
    boxes_.set(b, box);
    foreign.for_each_rank(box, [&](unsigned rank) { near_[rank].push_back(b); });
  }
  boxes_.refresh(0, blocks);
}

void Border::gather(const HeldPart& part, const ForeignTops& tops) {
  const std::span<const Sphere> spheres = part.chain().spheres();
  for (std::uint32_t p = 0; p < part.pieces().size(); ++p) {
    const auto [first, begin, size, strand] = part.pieces()[p];
    for (std::uint32_t done = 0; done < size; done += stretch) {
      const std::uint32_t end = std::min(size, done + stretch);
      if (!meets(tops, box_around(spheres.subspan(begin + done, end - done)))) continue;
      for (std::uint32_t at = done; at < end; at += Block::most) {
        const Block block{p, begin + at, std::min(Block::most, end - at)};
        if (meets(tops, box_around(part.spheres(block)))) blocks_.push_back(block);
      }
    }
  }
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
