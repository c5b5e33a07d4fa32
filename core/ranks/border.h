#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/ranks/held_part.h"
#include "catena/core/ranks/tops.h"

namespace catena::ranks {

/// Whether a rank compares this block of its border, where it compares those of `compared`: see
/// Border::compared.
constexpr bool is_compared(std::uint32_t block, std::uint32_t compared) {
  return (block & compared) == compared;
}

/// The blocks of a part that may touch other ranks, as their boxes meet a top of one: a small part of a part
/// that is compact in space. In the order of Morton codes, with a tree over their boxes, and with their
/// spheres side by side, which lie anywhere in the part.
class Border {
 public:
  /// All ranks call it. O(blocks), and O(b (log b + t)) for b blocks of the border, which meet t tops each: a
  /// few where blocks are compact, else up to all.
  Border(Communicator& ranks, const HeldPart& part);

  std::span<const Block> blocks() const { return blocks_; }
  std::span<const Sphere> spheres(std::uint32_t block) const { return {eight(block), blocks_[block].size}; }
  /// Where they are: eight, of which the first are the block's.
  const Sphere* eight(std::uint32_t block) const { return &spheres_[begin_[block]]; }
  /// The number of a block's first sphere in the whole chain.
  SphereId id(std::uint32_t block) const { return ids_[block]; }
  const WideBoxTree& boxes() const { return boxes_; }
  /// Whether any block may touch this rank.
  bool near(unsigned rank) const { return partners_[rank].near > 0; }
  /// Of the blocks that may touch a higher rank all, of those that may touch a lower one about half: this
  /// rank tells it of them, and it compares them with its own. Ascending.
  std::span<const std::uint32_t> told(unsigned rank) const { return partners_[rank].told; }
  /// The bit that the numbers of those blocks have which this rank compares with all of a lower one, so does
  /// not tell it of; 0, which all numbers have, for a higher one.
  std::uint32_t compared(unsigned rank) const { return partners_[rank].compared; }
  /// About how many blocks it will be told of.
  std::size_t expected(unsigned rank) const {
    return compared(rank) != 0 ? partners_[rank].near : (partners_[rank].near + 1) / 2;
  }

 private:
  struct Partner {
    std::vector<std::uint32_t> told;
    std::size_t near = 0;  ///< blocks that may touch it
    std::uint32_t compared = 0;
  };

  std::vector<Block> blocks_;
  std::vector<SphereId> ids_;         // [block]
  std::vector<std::uint32_t> begin_;  // [block]: of its spheres
  LargeVector<Sphere> spheres_;       // and seven more
  WideBoxTree boxes_;
  std::vector<Partner> partners_;  // [rank]
};

}  // namespace catena::ranks
