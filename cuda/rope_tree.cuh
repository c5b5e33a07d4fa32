#pragma once
#include <cstdint>

#include "catena/core/cells/met.h"
#include "catena/core/cells/sphere_cells.h"
#include "catena/core/chain/chain_view.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/host_device.h"

namespace catena::cuda {

/// A binary tree of boxes over sorted spheres, whose nodes know where a search goes on when it leaves their
/// subtree out: plain pointers on the device. Inner nodes are 0 (the root) to n - 2, leaf k is node n - 1 +
/// k.
struct RopeTree {
  static constexpr std::uint32_t end = 0xFFFFFFFFu, untouched = 0xFFFFFFFFu;
  struct alignas(16) Node {
    Box box;
    std::uint32_t left;  ///< child; of a leaf the index of its sphere
    std::uint32_t rope;  ///< the node after this one's subtree, or `end`
  };

  std::uint32_t leaves;
  Node* node;
  std::uint32_t*
      range;  ///< by place between two leaves: where the child that came first ends; at first untouched
  const std::uint64_t* code;  ///< by leaf, ascending
  const std::uint32_t* id;    ///< by leaf

  CATENA_HD std::uint32_t leaf(std::uint32_t k) const { return leaves - 1 + k; }
  CATENA_HD bool is_leaf(std::uint32_t at) const { return at >= leaves - 1; }

  /// How leaves k and k + 1 differ: the larger, the higher the node that parts them. Equal codes differ by
  /// place.
  __device__ std::uint64_t difference(std::uint32_t k) const {
    if (k >= leaves - 1) return ~std::uint64_t{0};  // behind the last, and before the first, where k is -1
    const std::uint64_t bits = code[k] ^ code[k + 1];
    return bits != 0 ? bits + (std::uint64_t{1} << 32) : k ^ (k + 1);
  }
  __device__ std::uint32_t rope_behind(std::uint32_t last) const {
    if (last == leaves - 1) return end;
    return difference(last) < difference(last + 1) ? leaf(last + 1) : last + 1;
  }
};

/// One thread a leaf, bottom up; of two children the one that comes second makes their parent (Apetrei 2014,
/// with the ropes and numbers of Prokopenko and Lebrun-Grandie 2024).
template <class Chain>
__global__ void __launch_bounds__(256)
    build_rope_tree(const __grid_constant__ Chain chain, const __grid_constant__ RopeTree tree) {
  const std::uint32_t k = blockIdx.x * blockDim.x + threadIdx.x;
  if (k >= tree.leaves) return;
  std::uint32_t at = tree.leaf(k), first = k, last = k;
  Box box = Box::around(chain.spheres[tree.id[k]]);
  tree.node[at] = {box, tree.id[k], tree.rope_behind(last)};
  std::uint64_t before = tree.difference(first - 1), behind = tree.difference(last);
  while (at != 0) {
    // Which neighbour this node shares its parent with, and what that one left behind when it came first.
    const bool is_left = behind < before;
    const std::uint32_t between = is_left ? last : first - 1;
    // The parent's maker must see the other child's box: written before this fence, read after that of the
    // second one.
    __threadfence();
    const std::uint32_t other_end = atomicExch(tree.range + between, is_left ? first : last);
    if (other_end == RopeTree::untouched) return;
    __threadfence();
    std::uint32_t left = at, other;
    if (is_left) {
      other = between + 1 == other_end ? tree.leaf(other_end) : between + 1;
      last = other_end;
      behind = tree.difference(last);
    } else {
      left = other = between == other_end ? tree.leaf(other_end) : between;
      first = other_end;
      before = tree.difference(first - 1);
    }
    const volatile Box& others = tree.node[other].box;  // not from a cache that never saw it
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = fminf(box.low[axis], others.low[axis]);
      box.high[axis] = fmaxf(box.high[axis], others.high[axis]);
    }
    at = behind < before ? last : first;
    tree.node[at] = {box, left, tree.rope_behind(last)};
  }
}

/// The leaf against all that come after it in the tree: first its own rope, then without a stack. Each pair
/// once. A sink that `listens`, which only one on the host does, is also told of each sphere it is compared
/// with, sink.compared(i, j), and each node it leaves out, sink.apart(i, node).
template <class Tests, class Sink>
class RopeSearch {
 public:
  CATENA_HD RopeSearch(const ChainView& chain, const RopeTree& tree, Sink& sink)
      : chain_(chain), tree_(tree), sink_(sink) {}

  /// All threads of a warp come together; one that is not `live` has no leaf, and any will do.
#pragma nv_exec_check_disable
  CATENA_HD void run(std::uint32_t leaf, bool live) const {
    const RopeTree::Node own = tree_.node[tree_.leaf(leaf)];
    sink_.asks({chain_.spheres[own.left], own.left});
    std::uint32_t at = live ? own.rope : RopeTree::end;
    while (sink_.any(at != RopeTree::end)) {
      const bool there = at != RopeTree::end;
      const RopeTree::Node other = tree_.node[there ? at : 0];
      const bool meets = there && own.box.meets(other.box), near = meets && tree_.is_leaf(at);
      if constexpr (listens) {
        if (!meets)
          sink_.apart(own.left, at);
        else if (near)
          sink_.compared(own.left, other.left);
      }
      sink_.near_one(*this, 0, other.left, near);
      if (there) at = meets && !near ? other.left : other.rope;
    }
  }

  /// Of spheres: what NearQueue asks of places.
  CATENA_HD Met met(const PlacedSphere& own, std::uint32_t j, std::uint32_t) const {
    const Sphere a = own.sphere, b = chain_.spheres[j];
    const bool excluded = chain_.exclusion.neighbours(own.index, j, a.radius, b.radius);
    return {own.index, j, Tests::overlap_unless(excluded, a, b)};
  }

 private:
  static constexpr bool listens = requires(Sink sink) { sink.apart(0u, 0u); };

  const ChainView& chain_;
  const RopeTree& tree_;
  Sink& sink_;
};

}  // namespace catena::cuda
