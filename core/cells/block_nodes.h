#pragma once
#include <cstdint>
#include <cstring>

#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/cells/node_box.h"

namespace catena {

/// A tree of boxes over the blocks of a CapsuleBlocks, in the order of the chain: eight children a node, of
/// two levels or more, up to the first one of at most `at_top` nodes; level 0 are the blocks. Plain
/// pointers, valid in one memory space.
struct BlockNodes {
  static constexpr std::uint32_t children = 8, most_levels = 10, most_at_top = 512;

  std::uint32_t top;                 ///< level, at least 2
  std::uint32_t count[most_levels];  ///< nodes of a level
  std::uint32_t first[most_levels];  ///< where they begin
  /// Of the boxes of levels from 1 on, one after the other, all first quarters, then all second ones and so
  /// on: threads that ask for boxes side by side ask for memory side by side.
  struct alignas(16) Quarter {
    float of[4];
  };
  static constexpr std::uint32_t quarters = sizeof(NodeBox) / sizeof(Quarter);
  Quarter* quarter;

  /// What sizes a tree over so many blocks has; memory is the caller's to give.
  static BlockNodes over(std::uint32_t blocks, std::uint32_t at_top = most_at_top) {
    BlockNodes result{};
    result.count[0] = blocks;
    do {
      const std::uint32_t l = ++result.top, below = result.count[l - 1];
      result.count[l] = below / children + (below % children != 0);
      result.first[l] = l == 1 ? 0 : result.first[l - 1] + result.count[l - 1];
    } while (result.count[result.top] > at_top || result.top < 2);
    return result;
  }
  CATENA_HD std::uint32_t nodes() const { return first[top] + count[top]; }

  CATENA_HD NodeBox box(std::uint32_t level, std::uint32_t node) const {
    Quarter all[quarters];
    for (std::uint32_t k = 0; k < quarters; ++k) all[k] = quarter[at(level, node, k)];
    NodeBox result;
    std::memcpy(&result, all, sizeof result);
    return result;
  }
  CATENA_HD void put(std::uint32_t level, std::uint32_t node, const NodeBox& box) const {
    Quarter all[quarters];
    std::memcpy(all, &box, sizeof box);
    for (std::uint32_t k = 0; k < quarters; ++k) quarter[at(level, node, k)] = all[k];
  }
  CATENA_HD bool in_a_row(std::uint32_t level, std::uint32_t node) const {
    return box(level, node).in_a_row != 0;
  }

 private:
  CATENA_HD std::size_t at(std::uint32_t level, std::uint32_t node, std::uint32_t k) const {
    return std::size_t{nodes()} * k + first[level] + node;
  }
};

/// The boxes of a BlockNodes, after the blocks' capsules are known, and what they say.
class NodeMeeting {
 public:
  CATENA_HD NodeMeeting(const BlockNodes& nodes, const CapsuleBlocks& blocks)
      : nodes_(nodes), blocks_(blocks) {}

  /// The box of a node, once those below it are there; by a team of eight.
  template <class Team>
  CATENA_HD NodeBox fit(const Team& team, std::uint32_t level, std::uint32_t node) const {
    const std::uint32_t begin = node * BlockNodes::children, last = nodes_.count[level - 1] - 1;
    const auto child = [&](std::uint32_t k) { return begin + k < last ? begin + k : last; };
    if (level == 1) {
      const auto at = [&](std::uint32_t k) { return blocks_.capsule[child(k)]; };
      const NodeFit fit(team, at);
      NodeBox box = fit.box();
      const bool in_a_row = fit.in_a_row(box), ordered = team.none([&](std::uint32_t k) {
        return k + 1 < Team::lanes && !blocks_.ordered(child(k));
      });
      // Only where there are all eight: a copy of the last would not follow it.
      box.in_a_row = in_a_row && ordered && begin + BlockNodes::children <= last + 1 ? 1 : 0;
      return box;
    }
    const auto at = [&](std::uint32_t k) { return nodes_.box(level - 1, child(k)); };
    return NodeFit(team, at).box();
  }

  /// Whether a node of level 1 may meet a block of another one.
  CATENA_HD bool may_hold(std::uint32_t node, std::uint32_t block) const {
    return nodes_.box(1, node).may_hold(blocks_.capsule[block]);
  }
  CATENA_HD bool may_meet(std::uint32_t level, std::uint32_t a, std::uint32_t b) const {
    if (level > 0) return may_meet(nodes_.box(level, a), nodes_.box(level, b));
    const BlockCapsule first = blocks_.capsule[a], second = blocks_.capsule[b];
    const bool own_units = blocks_.own_units;
    return !blocks_.settled(a, b) && !far_apart(ball_of(first), ball_of(second), own_units) &&
           !separate(first, second, own_units);
  }
  CATENA_HD static bool may_meet(const NodeBox& a, const NodeBox& b) {
    return a.may_hold(b) && b.may_hold(a);
  }

 private:
  const BlockNodes& nodes_;
  const CapsuleBlocks& blocks_;
};

}  // namespace catena
