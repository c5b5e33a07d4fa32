#include <algorithm>
#include <limits>

#include "catena/core/arithmetic/in_range.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/hierarchy/box_tree.h"
#include "catena/core/strategy/range_checks.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// Half traversal (after ArborX, Prokopenko and Lebrun-Grandie 2024): each leaf against what comes after it
/// in the tree, so that every pair of spheres is met once. No stack: a tree in preorder is gone through as it
/// lies in memory, and a node that the leaf's box does not meet is skipped.
template <class Arithmetic>
class Half final : public Traversal<BoxTree> {
 public:
  void find(const ChainView& chain, const BoxTree& tree, const Request& request,
            Collisions& result) override {
    in_range_ = in_range<Arithmetic>(chain);
    search(chain, tree, request, result, NoEvidence{});
  }

  Plan plan() const override { return range_checks_plan<Arithmetic>(in_range_); }
  std::uint32_t most_levels() const override { return std::numeric_limits<std::uint32_t>::max(); }
  Accounting evidence() const override { return Accounting::each_pair; }

  void find_with_evidence(const ChainView& chain, const BoxTree& tree, const Request& request,
                          Collisions& result, EvidenceSink& sink) override {
    search<EvidenceSink&>(chain, tree, request, result, sink);
  }

 private:
  template <class Tests, class Sink>
  struct Search {
    const ChainView& chain;
    const BoxTree& tree;
    PairCollector::Lane& lane;
    Sink sink;

    void all() {
      for (std::uint32_t k = 0; k < tree.nodes && !lane.satisfied(); ++k)
        if (tree.is_leaf(k)) within(k), after(k);
    }

    void within(std::uint32_t leaf) {
      for (std::uint32_t a = tree.begin(leaf); a < tree.end(leaf); ++a)
        for (std::uint32_t b = a + 1; b < tree.end(leaf); ++b) spheres(tree.item[a], tree.item[b]);
    }

    void after(std::uint32_t leaf) {
      const Box box = tree.node[leaf].box;
      for (std::uint32_t k = leaf + 1; k < tree.nodes;) {
        sink.compared(tree.id(leaf), tree.id(k));
        if (!box.meets(tree.node[k].box)) {
          sink.discarded(tree.id(leaf), tree.id(k));
          k = tree.node[k].skip;
        } else {
          if (tree.is_leaf(k)) leaves(leaf, k);
          ++k;
        }
      }
    }

    void leaves(std::uint32_t p, std::uint32_t q) {
      for (std::uint32_t a = tree.begin(p); a < tree.end(p); ++a)
        for (std::uint32_t b = tree.begin(q); b < tree.end(q); ++b) spheres(tree.item[a], tree.item[b]);
    }

    void spheres(const BoxTree::Item& a, const BoxTree::Item& b) {
      const auto [i, j] = std::minmax(a.id, b.id);
      if constexpr (std::is_same_v<Sink, EvidenceSink&>)
        chain.neighbours(i, j) ? sink.excluded(i, j) : sink.tested(i, j);
      if (!Tests::overlap(Tests::bound(a.sphere), Tests::bound(b.sphere))) [[likely]]
        return;
      if (!chain.neighbours(i, j)) lane.collide(i, j);
    }
  };

  template <class Sink>
  static void search(const ChainView& chain, const BoxTree& tree, const Request& request, Collisions& result,
                     Sink sink) {
    PairCollector collector(chain.size, request, result);
    with_tests_for<Arithmetic>(chain, [&](auto tests) {
      Search<decltype(tests), Sink>{chain, tree, collector.lane(0), sink}.all();
    });
    collector.finish();
  }

  bool in_range_ = false;  ///< of the last search
};

const RegisterTraversal<Half, Robust> registered{
    {.name = "Half", .summary = "each leaf against what comes after it in the tree, sequential"}};

}  // namespace
}  // namespace catena
