#include "catena/core/ranks/block.h"

#include "catena/core/hierarchy/box_around.h"

namespace catena::ranks {

std::uint64_t blocks_of(std::span<const Piece> pieces) {
  std::uint64_t blocks = 0;
  for (const Piece& piece : pieces) blocks += (std::uint64_t{piece.size} + Block::most - 1) / Block::most;
  return blocks;
}

LargeVector<Box> boxes_of(std::span<const Piece> pieces, std::span<const Sphere> spheres) {
  LargeVector<Box> boxes(blocks_of(pieces));
  Box* to = boxes.data();
  for_each_block(pieces,
                 [&](const Block& block) { *to++ = box_around(spheres.subspan(block.begin, block.size)); });
  return boxes;
}

}  // namespace catena::ranks
