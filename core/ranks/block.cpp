#include "catena/core/ranks/block.h"

#include "catena/core/hierarchy/box_around.h"

namespace catena::ranks {

std::uint64_t blocks_of(std::span<const Piece> pieces) {
  std::uint64_t blocks = 0;
  for (const Piece& piece : pieces) blocks += (std::uint64_t{piece.size} + Block::most - 1) / Block::most;
  return blocks;
}

LargeVector<Box> boxes_of_stretches(std::span<const Piece> pieces, std::span<const Sphere> spheres) {
  const std::uint64_t blocks = blocks_of(pieces);
  LargeVector<Box> boxes((blocks + stretch - 1) / stretch);
  Box* to = boxes.data();
  std::uint64_t left = blocks;
  std::uint32_t begin = 0, in_it = 0;
  for_each_block(pieces, [&](const Block& block) {
    --left;
    if (++in_it < stretch && left > 0) return;
    const std::uint32_t end = block.begin + block.size;
    *to++ = box_around(spheres.subspan(begin, end - begin));
    begin = end, in_it = 0;
  });
  return boxes;
}

}  // namespace catena::ranks
