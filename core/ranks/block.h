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

/// Blocks of a part that follow one another are a stretch: up to eight, and none beyond the end of a piece,
/// as the next piece may be anywhere. But a stretch has the spheres of a full block at least, so that many
/// pieces of few spheres are not as many stretches; only the last may have less.
class Stretches {
 public:
  static constexpr std::uint32_t most = 8;  ///< blocks

  explicit Stretches(std::span<const Piece> pieces) : pieces_(pieces) {}
  /// Whether the next block, in their order, is the last of its stretch.
  bool end_with(const Block& block) {
    const Piece& piece = pieces_[block.piece];
    const bool ends_piece = block.begin + block.size == piece.begin + piece.size;
    spheres_ += block.size;
    const bool ends =
        ++blocks_ == most || (ends_piece && (spheres_ >= Block::most || &piece == &pieces_.back()));
    if (ends) blocks_ = spheres_ = 0;
    return ends;
  }

 private:
  std::span<const Piece> pieces_;
  std::uint32_t blocks_ = 0, spheres_ = 0;  ///< of the stretch, so far
};
/// Of each the box around its spheres.
LargeVector<Box> boxes_of_stretches(std::span<const Piece> pieces, std::span<const Sphere> spheres);

/// The sphere that tells where a block is.
inline const Sphere& middle_of(std::span<const Sphere> spheres, const Block& block) {
  return spheres[block.begin + block.size / 2];
}

}  // namespace catena::ranks
