#include "catena/properties/fuzz/interest.h"
#include "catena/core/hierarchy/sphere_bounds_visitor.h"

#include <algorithm>
#include <cmath>

namespace catena::properties {
namespace {

/// A hierarchy of spheres as shown by a variant.
class ShownTree final : public SphereBoundsVisitor {
 public:
  void sphere(std::uint32_t parent, const Sphere64& of_parent, std::uint32_t child,
              const Sphere64& of_child) override {
    at(parent).bound = of_parent;
    at(child).bound = of_child;
    at(child).has_parent = true;
    at(parent).children.push_back(child);
  }

  std::uint32_t root() const {
    for (std::uint32_t k = 0; k < nodes_.size(); ++k)
      if (!nodes_[k].has_parent && !nodes_[k].children.empty()) return k;
    return 0;
  }

  std::uint32_t depth(std::uint32_t node, std::uint32_t limit = 256) const {
    if (node >= nodes_.size() || limit == 0) return 0;
    std::uint32_t deepest = 0;
    for (const std::uint32_t child : nodes_[node].children)
      deepest = std::max(deepest, depth(child, limit - 1));
    return 1 + deepest;
  }

  /// The most nodes that wait at once while the sphere is searched for, depth first.
  std::size_t stack(const Sphere& s, std::uint32_t root, std::vector<std::uint32_t>& waiting) const {
    if (nodes_.empty()) return 0;
    waiting.assign(1, root);
    std::size_t most = 1;
    while (!waiting.empty()) {
      const Node& node = nodes_[waiting.back()];
      waiting.pop_back();
      for (const std::uint32_t child : node.children)
        if (!nodes_[child].children.empty() && near(s, nodes_[child].bound)) waiting.push_back(child);
      most = std::max(most, waiting.size());
    }
    return most;
  }

 private:
  struct Node {
    Sphere64 bound{};
    bool has_parent = false;
    std::vector<std::uint32_t> children;
  };
  Node& at(std::uint32_t id) {
    if (id >= nodes_.size()) nodes_.resize(id + 1);
    return nodes_[id];
  }
  /// Rounded: this only guides a search.
  static bool near(const Sphere& s, const Sphere64& b) {
    const double dx = b.x - s.x, dy = b.y - s.y, dz = b.z - s.z, reach = b.radius + s.radius;
    return dx * dx + dy * dy + dz * dz <= reach * reach;
  }

  std::vector<Node> nodes_;
};

}  // namespace

Interest InterestMeter::of(const Case& test, double margin) {
  ShownTree tree;
  tree_.build(test.chain);
  tree_.visit_bounds(tree);
  const std::uint32_t root = tree.root();
  std::size_t fullest = 0;
  std::vector<std::uint32_t> waiting;
  for (const Sphere& s : test.chain.spheres()) fullest = std::max(fullest, tree.stack(s, root, waiting));
  // A margin of 0 touches exactly; just above 0 is where filters err, so it scores by its exponent.
  const double tightness = margin > 0 && std::isfinite(margin) ? std::max(0.0, -std::log2(margin)) : 0;
  return {{static_cast<double>(tree.depth(root)), static_cast<double>(fullest), tightness,
           static_cast<double>(test.exact.pair_count)}};
}

void Pool::offer(const Chain& chain, const Interest& interest) {
  for (std::size_t t = 0; t < Interest::targets; ++t) {
    auto& best = best_[t];
    const double score = interest.score[t];
    if (best.size() == kept && score <= best.back().score) continue;
    const auto place = std::ranges::find_if(best, [&](const Entry& e) { return e.score < score; });
    best.insert(place, {score, chain});
    if (best.size() > kept) best.pop_back();
  }
}

const Chain& Pool::pick(Dice& dice) const {
  const auto& best = best_[dice.below(Interest::targets)];
  return best[dice.below(static_cast<std::uint32_t>(best.size()))].chain;
}

Interest Pool::best() const {
  Interest best;
  for (std::size_t t = 0; t < Interest::targets; ++t)
    if (!best_[t].empty()) best.score[t] = best_[t].front().score;
  return best;
}

}  // namespace catena::properties
