#pragma once
#include <cstdint>

#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/hierarchy/level.h"
#include "catena/core/host_device.h"
#include "catena/core/policies/bGPU2.h"

namespace catena::policy {

/// One stage of aGPU2 (Section 4.3, Figs. 9, 10): a level is cut into subtrees that blocks build
/// independently. Slots from `next` on: the inner nodes of the subtrees (SA), then their roots (R), which are
/// the next level.
class SubtreeStage {
 public:
  /// `leaves` nodes a subtree, at least 2.
  CATENA_HD SubtreeStage(Level level, std::uint32_t next, std::uint32_t leaves)
      : level_(level), next_(next), leaves_(leaves), subtrees_((level.size - 1) / leaves + 1) {}

  CATENA_HD std::uint32_t subtrees() const { return subtrees_; }

  /// The nodes of subtree s.
  CATENA_HD Level nodes(std::uint32_t s) const {
    const std::uint32_t begin = s * leaves_, size = s + 1 < subtrees_ ? leaves_ : level_.size - begin;
    return {level_.first + begin, size, level_.node(begin + size - 1)};
  }
  CATENA_HD std::uint32_t first_inner(std::uint32_t s) const { return next_ + s * (leaves_ - 2); }
  CATENA_HD std::uint32_t root_slot(std::uint32_t s) const { return first_root() + s; }

  /// R. A last subtree of a single node has that node as its root, where it is, and takes no slot of R.
  CATENA_HD Level roots() const {
    const bool single = nodes(subtrees_ - 1).size == 1;
    return {first_root(), subtrees_, single ? level_.last : first_root() + subtrees_ - 1};
  }
  /// The first slot after R.
  CATENA_HD std::uint32_t end() const {
    return first_root() + subtrees_ - (nodes(subtrees_ - 1).size == 1 ? 1 : 0);
  }

 private:
  CATENA_HD std::uint32_t first_root() const {
    const std::uint32_t last = nodes(subtrees_ - 1).size;
    return next_ + (subtrees_ - 1) * (leaves_ - 2) + (last > 2 ? last - 2 : 0);
  }

  Level level_;
  std::uint32_t next_, leaves_, subtrees_;
};

/// aGPU2: stages of subtrees while there are too many roots for one block, then bGPU2 builds the top S over
/// R. The executor decides how a stage's blocks run; this is what each block does.
template <class Arithmetic>
struct aGPU2 {
  /// The paper's subtree: 384 leaves by 192 threads.
  static constexpr std::uint32_t paper_subtree = 384;

  template <class Group>
  CATENA_HD static void build_subtree(Group& group, const HierarchyView<typename Arithmetic::Bound>& tree,
                                      const SubtreeStage& stage, std::uint32_t s) {
    bGPU2<Arithmetic>::build(group, tree, stage.nodes(s), stage.first_inner(s), stage.root_slot(s));
  }

  /// The whole construction; sets the tree's root and height. `run_stage(stage)` builds the subtrees of a
  /// stage, `run_top(level, next, root_slot)` is bGPU2 over R. With at most `block_leaves` roots S fits one
  /// block.
  template <class RunStage, class RunTop>
  static void build(HierarchyView<typename Arithmetic::Bound>& tree, std::uint32_t subtree,
                    std::uint32_t block_leaves, const RunStage& run_stage, const RunTop& run_top) {
    Level level = Level::leaves(tree.leaves);
    std::uint32_t next = tree.leaves;
    tree.height = 1;
    do {
      const SubtreeStage stage(level, next, subtree);
      run_stage(stage);
      tree.height += halvings(stage.nodes(0).size);
      level = stage.roots();
      next = stage.end();
    } while (level.size > block_leaves);
    tree.root = tree.size() - 1;
    if (level.size > 1) run_top(level, next, tree.root);
    tree.height += halvings(level.size);
  }
};

}  // namespace catena::policy
