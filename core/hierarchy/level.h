#pragma once
#include <cstdint>

#include "catena/core/hierarchy/hierarchy.h"
#include "catena/core/host_device.h"

namespace catena {

/// The nodes of one level of a pairwise tree: consecutive slots, but for the last node, which may have moved
/// up unchanged from a level below and so lie elsewhere (design: "an odd last node keeps its place").
struct Level {
  std::uint32_t first, size, last;

  CATENA_HD static Level leaves(std::uint32_t n) { return {0, n, n - 1}; }
  CATENA_HD std::uint32_t node(std::uint32_t k) const { return k + 1 == size ? last : first + k; }
  CATENA_HD std::uint32_t pairs() const { return size / 2; }

  /// The level above when its parents go to slots next, next + 1, ...
  CATENA_HD Level above(std::uint32_t next) const {
    return {next, size - pairs(), size % 2 ? last : next + pairs() - 1};
  }
};

/// Writes leaf i of the tree: sphere i of the chain.
template <class Arithmetic>
CATENA_HD void make_leaf(const HierarchyView<typename Arithmetic::Bound>& tree, const Sphere* spheres,
                         std::uint32_t i) {
  tree.bound[i] = Arithmetic::bound(spheres[i]);
  tree.links[i] = Links::of_leaf();
}

/// Writes the parent of nodes 2p and 2p + 1 of a level into `slot`.
template <class Arithmetic>
CATENA_HD void make_parent(const HierarchyView<typename Arithmetic::Bound>& tree, const Level& level,
                           std::uint32_t p, std::uint32_t slot) {
  const std::uint32_t left = level.node(2 * p), right = level.node(2 * p + 1);
  tree.bound[slot] = Arithmetic::parent(tree.bound[left], tree.bound[right]);
  tree.links[slot] = {left, right};
}

/// ceil(log2(size)): how many times a level of that size is halved until one node is left.
CATENA_HD inline std::uint32_t halvings(std::uint32_t size) {
  std::uint32_t times = 0;
  while (size > 1) size -= size / 2, ++times;
  return times;
}

}  // namespace catena
