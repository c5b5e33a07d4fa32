#include "catena/bench/examine/examine.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>

#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/enclosure.h"

namespace catena::bench {
namespace {

/// Gathers the inner nodes of a tree, and of each how its bound fails.
class Levels final : public SphereBoundsVisitor {
 public:
  explicit Levels(std::uint32_t leaves) : leaves_(leaves) {}

  void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
              const Sphere64& child) override {
    Node& node = nodes_[parent_id];
    node.children.push_back(child_id);
    if (reference::encloses(parent, child)) return;
    node.fails = true;
    node.shortfall = std::max(node.shortfall, reference::shortfall(parent, child));
  }

  /// From the leaves up. O(nodes).
  std::vector<LevelExamined> levels() {
    std::vector<LevelExamined> result;
    for (auto& [id, node] : nodes_) {
      const std::uint32_t level = level_of(id);
      if (result.size() < level) result.resize(level);
      LevelExamined& here = result[level - 1];
      here.level = level;
      ++here.parents;
      here.failing += node.fails;
      here.worst_shortfall = std::max(here.worst_shortfall, node.shortfall);
    }
    return result;
  }

 private:
  struct Node {
    std::vector<std::uint32_t> children;
    bool fails = false;
    double shortfall = 0;
    std::uint32_t level = 0;  // 0: not yet known
  };

  std::uint32_t level_of(std::uint32_t id) {  // as deep as the tree, which is at most 64
    if (id < leaves_) return 0;
    Node& node = nodes_.at(id);
    if (node.level == 0) {
      std::uint32_t below = 0;
      for (const std::uint32_t child : node.children) below = std::max(below, level_of(child));
      node.level = below + 1;
    }
    return node.level;
  }

  std::uint32_t leaves_;
  std::unordered_map<std::uint32_t, Node> nodes_;
};

template <class Arithmetic>
bool finds(const Sphere& a, const Sphere& b) {
  return Arithmetic::overlap(Arithmetic::bound(a), Arithmetic::bound(b));
}

}  // namespace

Examination examine(const std::string& arithmetic, const Chain& chain, const reference::Answer& exact) {
  const auto variant = StrategyRegistry::instance().make("aCPU2+CPU2/" + arithmetic);
  variant->build(chain);
  Collisions found;
  variant->find(chain, {}, found);
  std::ranges::sort(found.pairs);

  Examination result;
  std::vector<Pair> missing, invented;
  std::ranges::set_difference(exact.pairs, found.pairs, std::back_inserter(missing));
  std::ranges::set_difference(found.pairs, exact.pairs, std::back_inserter(invented));
  result.missing = missing.size();
  result.invented = invented.size();
  const auto asked = arithmetic == Literal::name ? finds<Literal> : finds<Double>;
  result.lost_by_tree = static_cast<std::uint64_t>(
      std::ranges::count_if(missing, [&](const Pair& p) { return asked(chain[p.i], chain[p.j]); }));

  Levels levels(chain.size());
  variant->visit_bounds(levels);
  result.levels = levels.levels();
  for (const LevelExamined& level : result.levels) {
    result.all.parents += level.parents;
    result.all.failing += level.failing;
    result.all.worst_shortfall = std::max(result.all.worst_shortfall, level.worst_shortfall);
  }
  return result;
}

}  // namespace catena::bench
