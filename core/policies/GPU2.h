#pragma once
#include <cstdint>

#include "catena/core/chain/chain_view.h"
#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/host_device.h"

namespace catena::policy {

/// GPU2 (Section 5.2): one sphere against the tree with an explicit stack. A node that the sphere may overlap
/// gives its two children; a leaf is decided. Each pop pushes at most two nodes of the next level, so the
/// stack never holds more than one node a level and one more: the height of the tree bounds it.
template <class Arithmetic>
class GPU2 {
  using Bound = typename Arithmetic::Bound;

 public:
  /// Sphere i against the whole tree.
  template <class V>
  CATENA_HD static void visit(std::uint32_t i, const ChainView& chain, const HierarchyView<Bound>& tree,
                              V& visitor) {
    if (tree.leaves < 2) return;
    GPU2 search(i, chain, tree);
    search.consider(tree.links[tree.root].left, visitor);
    search.consider(tree.links[tree.root].right, visitor);
    search.descend(visitor);
  }

  /// Sphere i against the subtree of one child of the root: 0 left, 1 right (GPUv2's two threads).
  template <class V>
  CATENA_HD static void visit_half(std::uint32_t i, std::uint32_t child, const ChainView& chain,
                                   const HierarchyView<Bound>& tree, V& visitor) {
    if (tree.leaves < 2) return;
    GPU2 search(i, chain, tree);
    search.consider(child == 0 ? tree.links[tree.root].left : tree.links[tree.root].right, visitor);
    search.descend(visitor);
  }

 private:
  CATENA_HD GPU2(std::uint32_t i, const ChainView& chain, const HierarchyView<Bound>& tree)
      : chain_(chain), tree_(tree), sphere_(tree.bound[i]), i_(i) {}

  template <class V>
  CATENA_HD void consider(std::uint32_t slot, V& visitor) {
    if (tree_.is_leaf(slot)) {
      if (slot == i_) return;
      if (chain_.neighbours(i_, slot)) return visitor.excluded(slot);
      visitor.tested_pair(slot);
      if (Arithmetic::overlap(sphere_, tree_.bound[slot])) visitor.hit(slot);
      return;
    }
    visitor.tested_node(slot);
    if (Arithmetic::may_overlap(sphere_, tree_.bound[slot]))
      stack_[size_++] = slot;
    else
      visitor.discarded(slot);
  }

  template <class V>
  CATENA_HD void descend(V& visitor) {
    while (size_ > 0) {
      const Links children = tree_.links[stack_[--size_]];
      consider(children.left, visitor);
      consider(children.right, visitor);
    }
  }

  const ChainView& chain_;
  const HierarchyView<Bound>& tree_;
  const Bound sphere_;
  const std::uint32_t i_;
  std::uint32_t size_ = 0;
  std::uint32_t stack_[max_hierarchy_height];
};

}  // namespace catena::policy
