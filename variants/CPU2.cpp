#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// CPU2 (Section 5.1): each sphere against the tree, recursively. O(n log n) on a chain with few collisions.
template <class Arithmetic>
class CPU2 final : public Traversal<typename Arithmetic::Bound> {
  using Bound = typename Arithmetic::Bound;

 public:
  void find(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
            Collisions& result) override {
    PairCollector collector(chain.size, request, result);
    PairCollector::Lane& lane = collector.lane(0);
    for (std::uint32_t i = 0; i < chain.size && !lane.satisfied(); ++i) {
      Search search{chain, tree, lane, tree.bound[i], i};
      if (!tree.is_leaf(tree.root)) search.children(tree.root);
      lane.count(i, search.collisions);
    }
    collector.finish();
  }

 private:
  struct Search {
    const ChainView& chain;
    const HierarchyView<Bound>& tree;
    PairCollector::Lane& lane;
    const Bound& sphere;
    const std::uint32_t i;
    std::uint32_t collisions = 0;

    /// "The sphere colliding provides its two children to check for collisions."
    void children(std::uint32_t slot) {
      node(tree.links[slot].left);
      node(tree.links[slot].right);
    }
    void node(std::uint32_t slot) {
      if (!tree.is_leaf(slot)) {
        if (Arithmetic::may_overlap(sphere, tree.bound[slot])) children(slot);
      } else if (slot != i && !chain.neighbours(i, slot) && Arithmetic::overlap(sphere, tree.bound[slot])) {
        ++collisions;
        if (i < slot) lane.pair(i, slot);
      }
    }
  };
};

const RegisterTraversal<CPU2, Robust, Literal, Double> registered{
    {.name = "CPU2", .summary = "each sphere against the tree, recursive, sequential"}};

}  // namespace
}  // namespace catena
