#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/ranks/block_message.h"
#include "catena/core/ranks/border.h"

namespace catena::ranks {

/// What blocks of other ranks meet of a border, in vectors, compiled once for each instruction set.

/// A block that came, one of the border, and which of their spheres may touch: bit 8 k + f for sphere k of
/// the border's and sphere f of the other, unless they are separate for certain.
struct Meeting {
  std::uint32_t far_block, own_block;
  std::uint64_t may_touch;
};

/// Appends those with any such spheres for the blocks from *far_block on, and moves that on, to the end or
/// until `most` boxes or more of the border were met. Returns how many were. Only blocks of the border are
/// looked at that this rank compares, as the marks of the others say.
std::uint64_t meet_border(const HeldPart& part, const Border& border, const FarBlocks& far,
                          std::uint64_t most, std::uint32_t& far_block, std::vector<Meeting>& meetings);

/// Whether a block with this box may touch a sphere of the border's blocks whose numbers have all bits of
/// `compared`: one's box meets it.
bool may_touch_border(const HeldPart& part, const Border& border, const Box& box, std::uint32_t compared);

}  // namespace catena::ranks
