#pragma once
#include "catena/core/cells/block_nodes.h"
#include "catena/core/cells/meet_blocks.h"

namespace catena {

/// Whom the blocks of a node of level 2 meet, found by a group of threads that goes down the tree with the
/// node's box: of all nodes of a level those that it may meet, and of these the children. Of those of level 1
/// each of its own children meets some, and of their blocks its own.
///
/// Where a box may meet more than `most` nodes of a level the chain's order says little of what is near: all
/// blocks in it are *tangled*, and find nobody here. Every other block finds all that it meets, tangled ones
/// too, whatever these find: of two of them either finds the other. So no group needs to know of another one,
/// and work is bounded for each.
class PartnerSearch {
 public:
  static constexpr std::uint32_t children = BlockNodes::children, blocks_of_node = children * children;
  static constexpr std::uint32_t room = 256;      ///< for nodes of level 1
  static constexpr std::uint32_t most_near = 33;  ///< of these by a child
  static constexpr std::uint32_t few = 48,
                                 few_pairs = 24;  ///< nodes, and pairs of them, that ask little of a group
  struct Memory {                                 ///< of a group
    static constexpr std::uint32_t together = 24;
    std::uint32_t met[BlockNodes::most_levels];  ///< by level
    std::uint32_t node[2][room];                 ///< levels of even and of odd numbers
    std::uint32_t near[children];                ///< by child: how many
    std::uint32_t nodes;                         ///< such pairs:
    std::uint32_t two_nodes[children * most_near];
    /// By pair of nodes: of the blocks of each whether the other one may meet them.
    std::uint8_t held[together][2 * children];
    std::uint32_t blocks;  ///< pairs of blocks, one of each:
    std::uint32_t two_blocks[together * blocks_of_node];
    std::uint32_t partners[blocks_of_node];  ///< by own block: how many
    bool left;                               ///< all blocks are left to the other search
  };

  CATENA_HD PartnerSearch(const BlockNodes& nodes, const CapsuleBlocks& blocks, Memory& memory)
      : nodes_(nodes), blocks_(blocks), meeting_(nodes, blocks), of_blocks_(blocks), memory_(memory) {}

  /// For node `own` of level 2, whose blocks are told of at the end (BlockMeeting::tell); by a group of
  /// threads, which ends in step.
  template <class Group>
  CATENA_HD void find(Group&& group, std::uint32_t own) const {
    clear(group);
    const bool tangled = !go_down(group, own);
    if (!tangled) {
      find_near_nodes(group, own);
      if (memory_.nodes > few_pairs) wait_for_survey(group);
      for (std::uint32_t first = 0; first < memory_.nodes && !memory_.left; first += Memory::together)
        find_near_blocks(group, own, first);
    }
    if (memory_.left) return group.barrier();  // before the memory is used again
    group.parallel(blocks_of_node, [this, own, tangled](std::uint32_t k) {
      const std::uint32_t b = own * blocks_of_node + k;
      if (b < blocks_.blocks)
        of_blocks_.tell(b, tangled || memory_.near[k / children] > most_near, memory_.partners[k]);
    });
    group.barrier();
  }

 private:
  template <class Group>
  CATENA_HD void clear(Group&& group) const {
    group.parallel(blocks_of_node, [this](std::uint32_t k) {
      memory_.partners[k] = 0;
      if (k < children) memory_.near[k] = 0;
      if (k < BlockNodes::most_levels) memory_.met[k] = 0;
      if (k == 0) memory_.nodes = 0, memory_.left = blocks_.left_by_now().all;
    });
    group.barrier();
  }

  /// To level 1; false where there are too many.
  template <class Group>
  CATENA_HD bool go_down(Group&& group, std::uint32_t own) const {
    if (memory_.left) return false;
    group.parallel(nodes_.count[nodes_.top],
                   [this, own](std::uint32_t node) { look_at(own, nodes_.top, node); });
    for (std::uint32_t level = nodes_.top;; --level) {
      group.barrier();
      const std::uint32_t met = memory_.met[level];
      if (met > most(level)) return false;
      if (level == 1) break;
      group.parallel(met * children, [this, own, level](std::uint32_t k) {
        const std::uint32_t node = memory_.node[level % 2][k / children] * children + k % children;
        if (node < nodes_.count[level - 1]) look_at(own, level - 1, node);
      });
    }
    if (memory_.met[1] > few) wait_for_survey(group);
    return !memory_.left;
  }
  /// Where much is to be done it pays to wait for the survey, which began before, but not for ever. A barrier
  /// lies between the last look at what it said and this.
  template <class Group>
  CATENA_HD void wait_for_survey(Group&& group) const {
    group.parallel(1, [this](std::uint32_t) {
      CapsuleBlocks::Left left = blocks_.left_by_now();
      for (std::uint32_t k = 0; k < 64 && !left.known; ++k) wait_a_moment(), left = blocks_.left_by_now();
      memory_.left = left.all;
    });
    group.barrier();
  }
  /// Its own ancestors and children too. Tangled blocks that are looked for in cells are better not so.
  CATENA_HD std::uint32_t most(std::uint32_t level) const {
    const std::uint32_t in_cells = level > 1 ? room / 2 : room;
    return blocks_.in_cells ? in_cells : in_cells / 2;
  }
  CATENA_HD void look_at(std::uint32_t own, std::uint32_t level, std::uint32_t node) const {
    if (!meeting_.may_meet(nodes_.box(2, own), nodes_.box(level, node))) return;
    const std::uint32_t at = fetch_add(memory_.met + level, 1);
    if (at < room) memory_.node[level % 2][at] = node;
  }

  template <class Group>
  CATENA_HD void find_near_nodes(Group&& group, std::uint32_t own) const {
    group.parallel(memory_.met[1] * children, [this, own](std::uint32_t k) {
      const std::uint32_t of_own = k % children, a = own * children + of_own,
                          b = memory_.node[1][k / children];
      if (a >= nodes_.count[1] || seen(memory_.near + of_own) > most_near) return;
      if (a == b ? nodes_.in_a_row(1, a) : !meeting_.may_meet(1, a, b)) return;
      if (fetch_add(memory_.near + of_own, 1) < most_near)
        memory_.two_nodes[fetch_add(&memory_.nodes, 1)] = of_own << 29 | b;
    });
    group.barrier();
  }

  /// Of some pairs of nodes.
  template <class Group>
  CATENA_HD void find_near_blocks(Group&& group, std::uint32_t own, std::uint32_t first) const {
    const std::uint32_t left = memory_.nodes - first,
                        pairs = left < Memory::together ? left : Memory::together;
    group.parallel(pairs * 2 * children, [this, own, first](std::uint32_t k) {
      const Two nodes(memory_.two_nodes[first + k / (2 * children)], own);
      const bool of_own = k % (2 * children) < children;
      const std::uint32_t node = of_own ? nodes.a : nodes.b, block = node * children + k % children;
      memory_.held[k / (2 * children)][k % (2 * children)] =
          block < blocks_.blocks && !(of_own && enough(block % blocks_of_node)) &&
          (nodes.a == nodes.b || meeting_.may_hold(of_own ? nodes.b : nodes.a, block));
      if (k == 0) memory_.blocks = 0;
    });
    group.barrier();
    group.parallel(pairs * children, [this, own, first](std::uint32_t k) {
      const std::uint32_t pair = k / children, i = k % children;
      const std::uint8_t* const held = memory_.held[pair];
      if (held[i] == 0) return;
      const Two nodes(memory_.two_nodes[first + pair], own);
      const std::uint32_t a = (nodes.a % children * children + i) << 26, b = nodes.b * children;
      for (std::uint32_t j = 0; j < children; ++j)
        if (held[children + j] != 0) memory_.two_blocks[fetch_add(&memory_.blocks, 1)] = a | (b + j);
    });
    group.barrier();
    group.parallel(memory_.blocks, [this, own](std::uint32_t k) {
      const std::uint32_t of_own = memory_.two_blocks[k] >> 26, a = own * blocks_of_node + of_own,
                          b = memory_.two_blocks[k] & 0x3FFFFFFu;
      if (enough(of_own) || !meeting_.may_meet(0, a, b)) return;
      const std::uint32_t at = fetch_add(memory_.partners + of_own, 1);
      if (at < blocks_.crowd) blocks_.partner[a * CapsuleBlocks::most_partners + at] = b;
    });
    group.barrier();
  }
  /// Of an own block it is known that it is tangled, or crowded.
  CATENA_HD bool enough(std::uint32_t k) const {
    return memory_.near[k / children] > most_near || seen(memory_.partners + k) > blocks_.crowd;
  }
  /// A node of level 1 of the own one's, and another.
  struct Two {
    std::uint32_t a, b;
    CATENA_HD Two(std::uint32_t stored, std::uint32_t own)
        : a(own * children + (stored >> 29)), b(stored & 0x1FFFFFFFu) {}
  };

  const BlockNodes& nodes_;
  const CapsuleBlocks& blocks_;
  const NodeMeeting meeting_;
  const BlockMeeting of_blocks_;
  Memory& memory_;
};

}  // namespace catena
