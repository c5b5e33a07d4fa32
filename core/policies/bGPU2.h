#pragma once
#include <cstdint>

#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/hierarchy/level.h"
#include "catena/core/host_device.h"

namespace catena::policy {

/// The leaves of the tree from the spheres [begin, begin + count) of the chain, cut at its end; no barrier.
template <class Arithmetic, class Group>
CATENA_HD void copy_leaves(Group& group, const HierarchyView<typename Arithmetic::Bound>& tree,
                           const Sphere* spheres, std::uint32_t begin = 0, std::uint32_t count = ~0u) {
  const std::uint32_t left = tree.leaves - begin;
  group.parallel(count < left ? count : left,
                 [=](std::uint32_t k) { make_leaf<Arithmetic>(tree, spheres, begin + k); });
}

/// bGPU2 (Section 4.2): one block builds a tree over a level, a thread per pair and a barrier per level.
template <class Arithmetic>
struct bGPU2 {
  /// The paper's block has at most 768 threads, a thread per pair, so 1,536 leaves.
  static constexpr std::uint32_t paper_threads = 768;

  /// Parents go to slots next, next + 1, ...; the last one, the root, to root_slot. The level has at least 2
  /// nodes.
  template <class Group>
  CATENA_HD static void build(Group& group, const HierarchyView<typename Arithmetic::Bound>& tree,
                              Level level, std::uint32_t next, std::uint32_t root_slot) {
    while (level.size > 1) {
      const std::uint32_t parents = level.pairs(), first = level.size == 2 ? root_slot : next;
      group.parallel(parents, [=](std::uint32_t p) { make_parent<Arithmetic>(tree, level, p, first + p); });
      group.barrier();
      level = level.above(first);
      next += parents;
    }
  }
};

}  // namespace catena::policy
