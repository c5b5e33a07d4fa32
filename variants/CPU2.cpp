#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/policies/visitor.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// CPU2 (Section 5.1): each sphere against the tree, recursively. O(n log n) on a chain with few collisions.
template <class Arithmetic>
class CPU2 final : public Traversal<HierarchyView<typename Arithmetic::Bound>> {
  using Bound = typename Arithmetic::Bound;

 public:
  void find(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
            Collisions& result) override {
    in_range_ = in_range<Arithmetic>(chain);
    search_all(chain, tree, request, result, [](std::uint32_t) { return Visitor{}; });
  }

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }

  Accounting evidence() const override { return Accounting::from_both_ends; }

  void find_with_evidence(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
                          Collisions& result, EvidenceSink& sink) override {
    search_all(chain, tree, request, result, [&](std::uint32_t i) { return EvidenceVisitor(i, sink); });
  }

 private:
  /// `Observer` is told what the search left out, or is a Visitor that costs nothing.
  template <class Tests, class Observer>
  struct Search {
    const ChainView& chain;
    const HierarchyView<Bound> tree;  // copies: they stay in registers
    PairCollector::Lane& lane;
    const Bound sphere;
    const std::uint32_t i;
    [[no_unique_address]] Observer observer;
    std::uint32_t collisions = 0;

    /// "The sphere colliding provides its two children to check for collisions."
    void children(std::uint32_t slot) {
      node(tree.links[slot].left);
      node(tree.links[slot].right);
    }
    void node(std::uint32_t slot) {
      if (!tree.is_leaf(slot)) {
        observer.tested_node(slot);
        Tests::may_overlap(sphere, tree.bound[slot]) ? children(slot) : observer.discarded(slot);
      } else if (slot != i) {
        leaf(slot);
      }
    }
    void leaf(std::uint32_t j) {
      if (chain.neighbours(i, j)) return observer.excluded(j);
      observer.tested_pair(j);
      if (!Tests::overlap(sphere, tree.bound[j])) return;
      ++collisions;
      if (i < j) lane.pair(i, j);
    }
  };

  template <class Observe>
  static void search_all(const ChainView& chain, const HierarchyView<Bound>& tree, const Request& request,
                         Collisions& result, const Observe& observe) {
    PairCollector collector(chain.size, request, result);
    PairCollector::Lane& lane = collector.lane(0);
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      const SphereRange queries = collector.queries();
      for (std::uint32_t i = queries.begin; i < queries.end && !lane.satisfied(); ++i)
        lane.count(i, collisions_of<decltype(tests)>(i, chain, tree, lane, observe(i)));
    });
    collector.finish();
  }

  template <class Tests, class Observer>
  static std::uint32_t collisions_of(std::uint32_t i, const ChainView& chain,
                                     const HierarchyView<Bound>& tree, PairCollector::Lane& lane,
                                     const Observer& observer) {
    Search<Tests, Observer> search{chain, tree, lane, tree.bound[i], i, observer};
    if (!tree.is_leaf(tree.root)) search.children(tree.root);
    return search.collisions;
  }

  bool in_range_ = false;  ///< of the last search
};

const RegisterTraversal<CPU2, Robust, Literal, Double> registered{
    {.name = "CPU2", .summary = "each sphere against the tree, recursive, sequential"}};

}  // namespace
}  // namespace catena
