#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/ranks/held_part.h"
#include "catena/core/ranks/tops.h"

namespace catena::ranks {

/// The blocks of a part that may touch other ranks, as their boxes meet a top of one: a small part of a part
/// that is compact in space. In the order of Morton codes, with a tree over their boxes.
class Border {
 public:
  /// All ranks call it. O(blocks), and O(b log b) for b blocks of the border.
  Border(Communicator& ranks, const HeldPart& part);

  std::span<const Block> blocks() const { return blocks_; }
  const WideBoxTree& boxes() const { return boxes_; }
  /// The blocks that may touch this rank, ascending.
  std::span<const std::uint32_t> near(unsigned rank) const { return near_[rank]; }
  /// Of those the ones that this rank tells of itself to one that is lower, which compares them; all, to a
  /// higher one.
  std::span<const std::uint32_t> told(unsigned rank) const {
    return near(rank).first(rank < own_ ? half(rank) : near(rank).size());
  }
  /// The first block that this rank compares with those of another one.
  std::uint32_t first_compared(unsigned rank) const { return rank < own_ ? near(rank)[half(rank)] : 0; }

 private:
  std::size_t half(unsigned rank) const { return near_[rank].size() / 2; }

  unsigned own_;
  std::vector<Block> blocks_;
  WideBoxTree boxes_;
  std::vector<std::vector<std::uint32_t>> near_;  // [rank]
};

}  // namespace catena::ranks
