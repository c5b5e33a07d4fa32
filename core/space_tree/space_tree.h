#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/space_tree/box_levels.h"
#include "catena/core/space_tree/kept_order.h"
#include "catena/core/space_tree/space_order.h"

namespace catena {

/// Blocks of a BlockTree in the order of space, for where the chain's own says little of what is near: sorted
/// along a space-filling curve, sixteen that follow one another a node, in boxes along the axes of space. A
/// block that the chain jumps in is there in *parts*, which are blocks of the tree behind its own. A block or
/// part in this order is an *entry*. Lengths are the tree's, scaled; boxes are relative to `origin`.
struct SpaceTree {
  static constexpr std::uint32_t group = BlockTree::group;
  /// Fields of sixteen boxes: low x y z, high x y z.
  static constexpr std::uint32_t box_fields = 6;
  /// What boxes have on top of their slack: more than binary64 loses from the origin on
  /// (properties/proofs/axis_box_binary32.g).
  static constexpr float tiny = 0x1p-28f;

  float origin[3] = {};
  std::uint32_t entries = 0;
  LargeVector<std::uint32_t> block;  ///< [entry]: of the tree, or a part
  LargeVector<std::uint32_t> whole;  ///< [entry]: the block that it is of
  LargeVector<float> capsules;       ///< BlockTree::capsule_fields of each entry
  /// [level]: of entries, of nodes of sixteen, and so on to a single group; groups of sixteen.
  BoxLevels boxes;

  /// [entry], [node]: whether it is dense, all of it; see Crowding.
  LargeVector<std::uint8_t> dense_entry, dense_node;

  /// Of the build: entries before they are sorted.
  struct Unsorted {
    float capsule[BlockTree::capsule_fields];
    float low[3], high[3];
    std::uint32_t block, whole;
  };
  /// Spheres first to first + size - 1 of a block.
  struct Part {
    std::uint32_t block, first, size;
  };
  /// What one thread found.
  struct Gathered {
    LargeVector<Unsorted> entries;
    std::vector<Part> parts;
    std::uint32_t blocks = 0, broken = 0;  ///< it looked at; the chain jumps in
    /// The chain jumps in most: no block is worth its capsule.
    bool broken_up() const { return blocks > group * group && broken > blocks / 2; }
    void clear() { entries.clear(), parts.clear(), blocks = broken = 0; }
  };
  std::vector<Gathered> gathered;  ///< in the end the first has all
  LargeVector<Unsorted>& unsorted() { return gathered[0].entries; }
  std::vector<Part>& parts() { return gathered[0].parts; }
  SpaceOrder order;
  KeptOrder kept;

  std::uint32_t nodes() const { return (entries + group - 1) / group; }
  const float* boxes_of(std::size_t level, std::uint32_t g) const {
    return boxes[level].data() + std::size_t{g} * group * box_fields;
  }
  float* boxes_of(std::size_t level, std::uint32_t g) {
    return boxes[level].data() + std::size_t{g} * group * box_fields;
  }
};

}  // namespace catena
