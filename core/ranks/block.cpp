#include "catena/core/ranks/block.h"

#include "catena/core/hierarchy/box_around.h"

namespace catena::ranks {

std::uint64_t blocks_of(std::span<const Piece> pieces) {
  std::uint64_t blocks = 0;
  for (const Piece& piece : pieces) blocks += (std::uint64_t{piece.size} + Block::most - 1) / Block::most;
  return blocks;
}

LargeVector<Box> boxes_of_stretches(std::span<const Piece> pieces, std::span<const Sphere> spheres) {
  const auto for_each_end = [&](const auto& body) {
    Stretches stretches(pieces);
    for_each_block(pieces, [&](const Block& block) {
      if (stretches.end_with(block)) body(block.begin + block.size);
    });
  };
  std::size_t count = 0;
  for_each_end([&](std::uint32_t) { ++count; });
  LargeVector<Box> boxes(count);
  Box* to = boxes.data();
  std::uint32_t begin = 0;
  for_each_end([&](std::uint32_t end) {
    *to++ = box_around(spheres.subspan(begin, end - begin));
    begin = end;
  });
  return boxes;
}

}  // namespace catena::ranks
