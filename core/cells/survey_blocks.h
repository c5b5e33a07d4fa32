#pragma once
#include "catena/core/cells/block_nodes.h"

namespace catena {

/// Asks a few of a chain's blocks whom they meet, so that no more needs to be asked where to leave all
/// blocks to the other search takes less (CapsuleBlocks::all_left): each goes down the tree by itself, once
/// its boxes are there. Where the tree says little the block is tangled; who would look for it in cells does
/// not know of it here.
class BlockSurvey {
 public:
  static constexpr std::uint32_t room = 256;     ///< nodes of a level
  struct Memory {                                ///< of a group
    std::uint32_t met[BlockNodes::most_levels];  ///< by level
    std::uint32_t node[2][room];                 ///< levels of even and of odd numbers
  };

  /// Who meets more nodes of a level is tangled. Where tangled blocks are left to the grid that is soon said;
  /// to be looked for in cells they are better not.
  CATENA_HD static std::uint32_t most_nodes(const CapsuleBlocks& blocks) {
    return blocks.in_cells ? room : room / 4;
  }

  CATENA_HD BlockSurvey(const BlockNodes& nodes, const CapsuleBlocks& blocks, Memory& memory)
      : nodes_(nodes), blocks_(blocks), meeting_(nodes, blocks), memory_(memory) {}

  /// Asks the k-th of them; by a group of threads, which ends in step.
  template <class Group>
  CATENA_HD void ask(Group&& group, std::uint32_t k) const {
    const std::uint32_t b = blocks_.surveyed_block(k);
    const BlockCapsule own = blocks_.capsule[b];
    const auto look_at = [&](std::uint32_t level, std::uint32_t node) {
      if (level == 0 ? !meeting_.may_meet(0, b, node) : !nodes_.box(level, node).may_hold(own)) return;
      const std::uint32_t at = fetch_add(memory_.met + level, 1);
      if (level > 0 && at < room) memory_.node[level % 2][at] = node;
    };
    group.parallel(BlockNodes::most_levels, [&](std::uint32_t level) { memory_.met[level] = 0; });
    group.barrier();
    group.parallel(nodes_.count[nodes_.top], [&](std::uint32_t node) { look_at(nodes_.top, node); });
    bool tangled = false;
    for (std::uint32_t level = nodes_.top; level > 0 && !tangled; --level) {
      group.barrier();
      const std::uint32_t met = memory_.met[level];
      tangled = met > most_nodes(blocks_);
      group.parallel(tangled ? 0 : met * BlockNodes::children, [&look_at, level, this](std::uint32_t child) {
        const std::uint32_t node =
            memory_.node[level % 2][child / BlockNodes::children] * BlockNodes::children +
            child % BlockNodes::children;
        if (node < nodes_.count[level - 1]) look_at(level - 1, node);
      });
    }
    group.barrier();
    const std::uint32_t partners = memory_.met[0];
    group.parallel(1, [&](std::uint32_t) {
      CapsuleBlocks::Survey said{1, 0, 0, 0};
      if (!tangled || !blocks_.in_cells) {  // else nobody knows
        const bool crowded = tangled || partners > blocks_.crowd;
        said.crowded = crowded ? 1 : 0, said.others = crowded ? 0 : 1, said.partners = crowded ? 0 : partners;
      }
      add(&blocks_.state->survey, said.number());
    });
    group.barrier();
  }

 private:
  const BlockNodes& nodes_;
  const CapsuleBlocks& blocks_;
  const NodeMeeting meeting_;
  Memory& memory_;
};

}  // namespace catena
