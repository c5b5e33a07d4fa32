#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/ranks/block_message.h"
#include "catena/core/ranks/border.h"
#include "catena/core/ranks/told_block.h"

namespace catena::ranks {

/// What blocks of other ranks meet of a border, in vectors, compiled once for each instruction set.

/// A block that came, one of the border, and which of their spheres touch for certain, or may: bit 8 k + f
/// for sphere k of the border's and sphere f of the other.
struct Meeting {
  std::uint32_t far_block, own_block;
  std::uint64_t touch, may_touch;
};

/// Appends those with any such spheres for the blocks from far_block on, and moves that on, to the end or
/// until the boxes of `most` blocks of the border or more were met. Returns how many were. Only blocks of the
/// border are looked at that this rank compares, as the marks of the others say.
std::uint64_t meet_border(const Border& border, const FarBlocks& far, std::uint64_t most,
                          std::uint32_t& far_block, LargeVector<Meeting>& meetings);

/// Appends those that may touch a sphere of the border's blocks whose numbers have all bits of `compared`.
void may_touch_border(const Border& border, std::span<const ToldBlock> told, std::uint32_t compared,
                      std::vector<std::uint32_t>& blocks);

/// Appends what another rank is told of these blocks of the border.
void tell_of_border(const Border& border, std::span<const std::uint32_t> blocks,
                    std::vector<ToldBlock>& told);

}  // namespace catena::ranks
