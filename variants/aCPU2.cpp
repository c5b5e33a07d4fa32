#include "catena/core/hierarchy/level.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// aCPU2 (Section 4.1): bottom-up, level by level; nodes 2i and 2i + 1 of a level get a parent, an odd last
/// node moves up unchanged. The paper states O(n log n); it makes n - 1 nodes, so it is O(n).
template <class Arithmetic>
class aCPU2 final : public Construction<HierarchyView<typename Arithmetic::Bound>> {
  using Bound = typename Arithmetic::Bound;

 public:
  void build(const ChainView& chain) override {
    tree_ = storage_.reset(chain.size);
    if (chain.size == 0) return;
    for (std::uint32_t i = 0; i < chain.size; ++i) make_leaf<Arithmetic>(tree_, chain.spheres, i);
    construct(Level::leaves(chain.size), chain.size);
  }

  HierarchyView<Bound> hierarchy() const override { return tree_; }

 private:
  /// The paper's recursion: one level, then the routine again on its parents.
  void construct(Level level, std::uint32_t next) {
    if (level.size == 1) {
      tree_.root = level.node(0);
      return;
    }
    const HierarchyView<Bound> tree = tree_;  // a copy stays in registers
    for (std::uint32_t p = 0; p < level.pairs(); ++p) make_parent<Arithmetic>(tree, level, p, next + p);
    ++tree_.height;
    construct(level.above(next), next + level.pairs());
  }

  Hierarchy<Bound> storage_;
  HierarchyView<Bound> tree_{};
};

const RegisterConstruction<aCPU2, Robust, Literal, Double> registered{
    {.name = "aCPU2",
     .summary = "tree by pairs, bottom-up, sequential, O(n)",
     .promises = {.same_bits = true}}};

}  // namespace
}  // namespace catena
