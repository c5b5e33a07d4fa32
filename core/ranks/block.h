#pragma once
#include <algorithm>
#include <cstdint>
#include <span>

#include "catena/core/executor/large_vector.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/ranks/part.h"

namespace catena::ranks {

/// Up to eight consecutive spheres of one piece: what ranks tell one another of.
struct Block {
  static constexpr std::uint32_t most = 8;
  std::uint32_t piece, begin, size;
};

/// visit(block) for the blocks of some pieces, in their order: they are not kept, as most are needed once.
template <class Visit>
void for_each_block(std::span<const Piece> pieces, const Visit& visit) {
  for (std::uint32_t p = 0; p < pieces.size(); ++p)
    for (std::uint32_t done = 0; done < pieces[p].size; done += Block::most)
      visit(Block{p, pieces[p].begin + done, std::min(Block::most, pieces[p].size - done)});
}

/// visit(block) for one of every `step` blocks. O(pieces + blocks visited).
template <class Visit>
void for_some_blocks(std::span<const Piece> pieces, std::uint64_t step, const Visit& visit) {
  std::uint64_t next = step / 2;  // from the first block of the piece on
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    const std::uint32_t blocks = (pieces[p].size + Block::most - 1) / Block::most;
    for (; next < blocks; next += step) {
      const auto done = static_cast<std::uint32_t>(next) * Block::most;
      visit(Block{p, pieces[p].begin + done, std::min(Block::most, pieces[p].size - done)});
    }
    next -= blocks;
  }
}

std::uint64_t blocks_of(std::span<const Piece> pieces);

/// Blocks of a part that follow one another, eight but for the last, are a stretch: of each the box around
/// its spheres.
constexpr std::uint32_t stretch = 8;
LargeVector<Box> boxes_of_stretches(std::span<const Piece> pieces, std::span<const Sphere> spheres);

/// The sphere that tells where a block is.
inline const Sphere& middle_of(std::span<const Sphere> spheres, const Block& block) {
  return spheres[block.begin + block.size / 2];
}

}  // namespace catena::ranks
