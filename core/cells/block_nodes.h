#pragma once
#include <cstdint>

#include "catena/core/cells/capsule_blocks.h"
#include "catena/core/cells/node_box.h"

namespace catena {

/// A tree of boxes over the blocks of a CapsuleBlocks, in the order of the chain: eight children a node, up
/// to the first level of at most `most_at_top` nodes; level 0 are the blocks. It is compared with itself from
/// the top down, a level at a time: of each pair of nodes that may meet, the children.
///
/// A node that meets more than `crowd(level)` others is *tangled*, and so is all below it: the chain's order
/// says little of what is near. Pairs of two tangled blocks are left to another search; all others are found
/// here, by work that is bounded for each node. Plain pointers, valid in one memory space.
struct BlockNodes {
  static constexpr std::uint32_t children = 8, log2_children = 3, most_levels = 8, most_at_top = 1024;
  static constexpr std::uint32_t most_crowd_at_top = 128;

  /// Two nodes of a level; the top bit of each says that its parent is tangled.
  struct Meeting {
    std::uint32_t a, b;
  };
  static constexpr std::uint32_t below_tangled = 0x80000000u;

  struct State {
    std::uint32_t meetings[most_levels];  ///< by level: how many came, those without room too
    std::uint32_t tangled;                ///< not 0: there is a crowded node
  };

  std::uint32_t top;                 ///< level, at least 1
  std::uint32_t count[most_levels];  ///< nodes of a level
  std::uint32_t first[most_levels];  ///< where they begin
  std::uint32_t capacity;            ///< of each list
  NodeBox* box;                      ///< levels from 1 on, one after the other
  std::uint32_t* met;                ///< by node as well: others that it met; at first 0
  Meeting* meeting[2];               ///< lists of the levels of even and of odd numbers
  State* state;                      ///< at first 0

  /// What sizes a tree over so many blocks has, with room for so many meetings in a list, or by the number of
  /// blocks for 0; memory is the caller's to give.
  static BlockNodes over(std::uint32_t blocks, std::uint32_t meetings) {
    BlockNodes result{};
    result.count[0] = blocks;
    do {
      const std::uint32_t l = ++result.top, below = result.count[l - 1];
      result.count[l] = below / children + (below % children != 0);
      result.first[l] = l == 1 ? 0 : result.first[l - 1] + result.count[l - 1];
    } while (result.count[result.top] > most_at_top);
    result.capacity = meetings != 0 ? meetings : 2 * blocks + (1u << 19);
    return result;
  }
  CATENA_HD std::uint32_t nodes() const { return first[top] + count[top]; }
  CATENA_HD std::uint32_t at(std::uint32_t level, std::uint32_t node) const { return first[level] + node; }

  /// How many others a node of a level >= 1 may meet: one for eight spheres of its own, so that no level costs
  /// more than another. At the top all nodes of a chain in a ball meet one another, which is to be seen soon.
  CATENA_HD std::uint32_t crowd(std::uint32_t level) const {
    return level == top ? most_crowd_at_top : 32u << (log2_children * (level - 1));
  }
  CATENA_HD bool crowded(std::uint32_t level, std::uint32_t node) const {
    return met[at(level, node)] > crowd(level);
  }
  /// Whether a node or block is tangled, once all nodes have met from the level's above on, or its own.
  CATENA_HD bool tangled(std::uint32_t level, std::uint32_t node) const {
    if (level == 0) return tangled(1, node >> log2_children);
    bool any = false;
    for (; level <= top; ++level, node >>= log2_children) any |= crowded(level, node);
    return any;
  }

  /// The children of a node there are, bit k the k-th.
  CATENA_HD std::uint32_t children_of(std::uint32_t level, std::uint32_t node) const {
    const std::uint32_t left = count[level - 1] - node * children;
    return left < children ? (1u << left) - 1 : (1u << children) - 1;
  }

  CATENA_HD std::uint32_t meetings(std::uint32_t level) const {
    const std::uint32_t came = state->meetings[level];
    return came < capacity ? came : capacity;
  }
};

/// Steps of a BlockNodes, after the blocks' capsules are known; who runs them lets each end before the next
/// begins.
class NodeMeeting {
 public:
  using Meeting = BlockNodes::Meeting;
  CATENA_HD NodeMeeting(const BlockNodes& nodes, const CapsuleBlocks& blocks)
      : nodes_(nodes), blocks_(blocks) {}

  /// Step 1, from level 1 to the top, by a team of eight: the box of a node.
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
    const auto at = [&](std::uint32_t k) { return nodes_.box[nodes_.at(level - 1, child(k))]; };
    return NodeFit(team, at).box();
  }

  /// Step 2, of any two nodes a < b of the top.
  CATENA_HD bool may_meet_at_top(std::uint32_t a, std::uint32_t b) const {
    return may_meet(nodes_.box[nodes_.at(nodes_.top, a)], nodes_.box[nodes_.at(nodes_.top, b)]);
  }

  // Step 3, from the top down to level 1: of each node with itself, unless it has nothing to search, and each
  // meeting that is not left out, the children.
  /// Nothing is left to be found among the children: they are tangled, or blocks in a row, each settled with
  /// the next.
  CATENA_HD bool settled(std::uint32_t level, std::uint32_t node) const {
    return (level == 1 && nodes_.box[nodes_.at(1, node)].in_a_row != 0) || nodes_.tangled(level, node);
  }
  /// Both nodes are tangled; marks it where one is. A meeting at the top may be listed by both, the one that
  /// lists it first; then that of the lower number counts.
  CATENA_HD bool leaves_out(std::uint32_t level, Meeting& of) const {
    constexpr std::uint32_t mark = BlockNodes::below_tangled;
    if (level == nodes_.top && of.a > of.b && !nodes_.crowded(level, of.b)) return true;
    if ((of.a & mark) == 0 && nodes_.crowded(level, of.a)) of.a |= mark;
    if ((of.b & mark) == 0 && nodes_.crowded(level, of.b)) of.b |= mark;
    return (of.a & of.b & mark) != 0;
  }
  /// Whether a node may meet a child, of that level, of the other one.
  CATENA_HD bool may_hold(std::uint32_t child_level, std::uint32_t node, std::uint32_t child) const {
    const NodeBox& box = nodes_.box[nodes_.at(child_level + 1, node)];
    return child_level == 0 ? box.may_hold(blocks_.capsule[child])
                            : box.may_hold(nodes_.box[nodes_.at(child_level, child)]);
  }
  CATENA_HD bool may_meet(std::uint32_t level, std::uint32_t a, std::uint32_t b) const {
    if (level > 0) return may_meet(nodes_.box[nodes_.at(level, a)], nodes_.box[nodes_.at(level, b)]);
    const BlockCapsule first = blocks_.capsule[a], second = blocks_.capsule[b];
    return !blocks_.settled(a, b) && !far_apart(ball_of(first), ball_of(second)) && !separate(first, second);
  }

  /// Two nodes of a level >= 1 met: whether the meeting is to be put into the level's list. If not, both are
  /// tangled. Numbers only grow, so that what is seen to be crowded stays so, and needs not be counted
  /// further.
  CATENA_HD bool note(std::uint32_t level, std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t crowd = nodes_.crowd(level);
    std::uint32_t *const met_a = nodes_.met + nodes_.at(level, a), *const met_b =
                                                                       nodes_.met + nodes_.at(level, b);
    if (seen(met_a) > crowd && seen(met_b) > crowd) return false;
    const std::uint32_t of_a = fetch_add(met_a, 1), of_b = fetch_add(met_b, 1);
    if (of_a == crowd || of_b == crowd) set_bits(&nodes_.state->tangled, 1);
    return of_a < crowd || of_b < crowd;
  }
  /// There is no room: both are tangled from now on.
  CATENA_HD void give_up(std::uint32_t level, std::uint32_t a, std::uint32_t b) const {
    fetch_add(nodes_.met + nodes_.at(level, a), nodes_.crowd(level) + 1);
    fetch_add(nodes_.met + nodes_.at(level, b), nodes_.crowd(level) + 1);
    set_bits(&nodes_.state->tangled, 1);
  }

 private:
  CATENA_HD static bool may_meet(const NodeBox& a, const NodeBox& b) {
    return a.may_hold(b) && b.may_hold(a);
  }

  const BlockNodes& nodes_;
  const CapsuleBlocks& blocks_;
};

}  // namespace catena
