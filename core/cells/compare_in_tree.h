#pragma once
#include <cstdint>

#include "catena/core/cells/bits.h"
#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/compare_blocks.h"

namespace catena {

/// Compares the blocks of a chain by what their tree alone says: from each block down the tree to those that
/// come later, so that two blocks are compared once, however many meet one. By a warp, four blocks at a time,
/// whose threads ask eight children each; what is left to ask of a walk is a bit a child for each level, so
/// that there is no stack that could be full.
template <class Warp, bool own_units>
class TreeComparison {
 public:
  static constexpr std::uint32_t children = BlockNodes::children, together = Warp::lanes / children;

  /// Blocks are in_tree_alone; the tree's top level has no more than `children` nodes.
  CATENA_HD TreeComparison(const Warp& warp, const ChainView& chain, const BlockNodes& nodes,
                           const CapsuleBlocks& blocks)
      : warp_(warp),
        nodes_(nodes),
        blocks_(blocks),
        meeting_(nodes, blocks),
        comparison_(warp, chain, blocks) {}

  /// Blocks `first`, of which there is one, and the next three with themselves and all that come later; tells
  /// the sink as BlockComparison does.
  template <class Tests, class Sink>
  CATENA_HD void compare(std::uint32_t first, Sink& sink) const {
    for (std::uint32_t b = first; b < first + together && b < blocks_.blocks; ++b)
      comparison_.plan(b, [&](auto work) { comparison_.template compare<Tests>(b, work, sink); });
    auto walk = warp_.each([&](std::uint32_t lane) {
      return Walk{0, 0, nodes_.top, first + lane / children < blocks_.blocks};
    });
    while (warp_.ballot([&](std::uint32_t lane) { return walk[lane].goes_on; }) != 0) {
      const std::uint32_t met = warp_.ballot([&](std::uint32_t lane) {
        return walk[lane].goes_on && meets(first + lane / children, walk[lane].level, walk[lane].child(lane));
      });
      const auto child = warp_.each([&](std::uint32_t lane) { return walk[lane].child(lane); });
      for (std::uint32_t blocks =
               met & warp_.ballot([&](std::uint32_t lane) { return walk[lane].level == 0; });
           blocks != 0; blocks &= blocks - 1) {
        const std::uint32_t lane = lowest_bit(blocks);
        comparison_.template compare_two<Tests>(first + lane / children, warp_.from(child, lane), sink);
      }
      walk = warp_.each([&](std::uint32_t lane) {
        return walk[lane].after(met >> lane / children * children & ((1u << children) - 1));
      });
    }
  }

 private:
  /// Where a block's walk stands: it asks the children of a node, which are of `level`.
  struct Walk {
    std::uint64_t left;  ///< by level from 1 on, eight bits each: of the children asked there, who met
    std::uint32_t node;  ///< of the level above; 0 for the top level
    std::uint32_t level;
    bool goes_on;

    CATENA_HD std::uint32_t child(std::uint32_t lane) const { return node * children + lane % children; }
    /// After it is known whom of these the block met: the children of the nearest that has not been asked for
    /// its own.
    CATENA_HD Walk after(std::uint32_t met) const {
      if (!goes_on) return *this;
      const std::uint64_t all = level == 0 ? left : left | std::uint64_t{met} << (level - 1) * children;
      if (all == 0) return {0, 0, 0, false};
      const std::uint32_t lowest = lowest_bit_of_64(all), of = lowest / children + 1,
                          above = node >> 3 * (of - level);
      static_assert(children == 8);
      return {all & (all - 1), above * children + lowest % children, of - 1, true};
    }
  };
  static_assert((BlockNodes::most_levels - 2) * children <= 64);

  /// A child's subtree holds a later block that this one may meet.
  CATENA_HD bool meets(std::uint32_t b, std::uint32_t level, std::uint32_t child) const {
    if (child >= nodes_.count[level]) return false;
    if (level == 0) return child > b && meeting_.may_meet(0, b, child);
    const std::uint64_t end = (std::uint64_t{child} + 1) << 3 * level;
    if (end <= b + std::uint64_t{1}) return false;
    if (level == 1 && child == b / children && nodes_.in_a_row(1, child)) return false;
    return nodes_.box(level, child).may_hold(blocks_.capsule[b]);
  }

  const Warp& warp_;
  const BlockNodes& nodes_;
  const CapsuleBlocks& blocks_;
  const NodeMeeting meeting_;
  const BlockComparison<Warp, own_units> comparison_;
};

}  // namespace catena
