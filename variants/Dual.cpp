#include <algorithm>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// Dual: the tree against itself, sequential. Where two nodes may overlap the larger one gives its two
/// children; every pair of leaves is met once. A pair of far subtrees is left out in one step, so its
/// evidence is the shortest.
template <class Arithmetic>
class Dual final : public Traversal<HierarchyView<typename Arithmetic::Bound>> {
  using Bound = typename Arithmetic::Bound;

 public:
  void find(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
            Collisions& result) override {
    in_range_ = in_range<Arithmetic>(chain);
    search(chain, tree, request, result, NoEvidence{});
  }

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

  Accounting evidence() const override { return Accounting::each_pair; }

  void find_with_evidence(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
                          Collisions& result, EvidenceSink& sink) override {
    search<EvidenceSink&>(chain, tree, request, result, sink);
  }

 private:
  template <class Tests, class Sink>
  struct Search {
    const ChainView& chain;
    const HierarchyView<Bound> tree;  // copies: they stay in registers
    PairCollector::Lane& lane;
    Sink sink;

    /// All pairs of spheres below one node.
    void within(std::uint32_t node) {
      if (tree.is_leaf(node) || lane.satisfied()) return;
      const Links children = tree.links[node];
      within(children.left);
      within(children.right);
      between(children.left, children.right);
    }

    /// All pairs of a sphere below a with a sphere below b, which have none in common.
    void between(std::uint32_t a, std::uint32_t b) {
      if (lane.satisfied()) return;
      if (tree.is_leaf(a) && tree.is_leaf(b)) return leaves(std::min(a, b), std::max(a, b));
      sink.compared(a, b);
      if (!Tests::may_overlap(tree.bound[a], tree.bound[b])) return sink.discarded(a, b);
      if (tree.is_leaf(a) || (!tree.is_leaf(b) && tree.bound[a].radius < tree.bound[b].radius))
        std::swap(a, b);
      const Links children = tree.links[a];
      between(children.left, b);
      between(children.right, b);
    }

    void leaves(std::uint32_t i, std::uint32_t j) {
      if (chain.neighbours(i, j)) return sink.excluded(i, j);
      sink.tested(i, j);
      if (Tests::overlap(tree.bound[i], tree.bound[j])) lane.collide(i, j);
    }
  };

  template <class Sink>
  static void search(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
                     Collisions& result, Sink sink) {
    PairCollector collector(chain.size, request, result);
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      Search<decltype(tests), Sink> search{chain, tree, collector.lane(0), sink};
      if (chain.size > 0) search.within(tree.root);
    });
    collector.finish();
  }

  bool in_range_ = false;  ///< of the last search
};

const RegisterTraversal<Dual, Robust, Literal, Double> registered{
    {.name = "Dual", .summary = "the tree against itself, each pair of spheres met once, sequential"}};

}  // namespace
}  // namespace catena
