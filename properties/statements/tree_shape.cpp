#include <fmt/format.h>

#include <algorithm>

#include "catena/properties/property.h"
#include "catena/reference/enclosure.h"

namespace catena::properties {
namespace {

/// A hierarchy, where one is shown, is a tree: one root, every sphere below it exactly once, no inner node
/// without children. For every arithmetic, as rounding excuses no lost sphere. A tree whose nodes all have
/// two children or more has at most 2n - 1 of them. Levels that the builder counted are the tree's: the limit
/// of the traversals' stacks rests on that number.
class TreeShape final : public Property {
 public:
  std::string name() const override { return "tree shape"; }

  std::optional<std::string> check(const Subject&, Variant& variant, const Case& test) override {
    variant.build(test.chain);
    reference::EnclosureChecker checker(test.chain);
    variant.visit_bounds(checker);
    const auto shape = checker.shape();
    if (!shape.is_tree())
      return fmt::format("not a tree: {} roots, {} spheres lost, {} nodes shared, {} unreached, {} barren",
                         shape.roots, shape.lost_leaves, shape.shared, shape.lost_inner, shape.barren);
    const std::uint64_t n = test.chain.size();
    const std::uint32_t levels = shape.nodes > 0 ? shape.depth : std::min<std::uint64_t>(n, 1);
    if (checker.levels().value_or(levels) != levels)
      return fmt::format("{} levels counted, {} there", *checker.levels(), levels);
    if (shape.nodes > 2 * n) return fmt::format("{} nodes for {} spheres", shape.nodes, n);
    return std::nullopt;
  }
};

const RegisterProperty<TreeShape> registered;

}  // namespace
}  // namespace catena::properties
