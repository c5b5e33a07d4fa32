#include "catena/properties/counterexamples/observed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "catena/core/arithmetic/paper_formulas.h"
#include "catena/core/hierarchy/sphere_bounds_visitor.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/all_pairs.h"

namespace catena::properties {
namespace {

template <class Real>
Format format_of() {
  using Limits = std::numeric_limits<Real>;
  return {Limits::denorm_min(), Limits::min(), Limits::max()};
}

class Parents final : public SphereBoundsVisitor {
 public:
  void sphere(std::uint32_t parent_id, const Sphere64& parent, std::uint32_t child_id,
              const Sphere64& child) override {
    ParentSeen& seen = seen_[parent_id];
    seen.parent = parent;
    seen.ids.push_back(child_id);
    seen.children.push_back(child);
  }
  std::vector<ParentSeen> take() {
    std::vector<ParentSeen> all;
    for (auto& [id, parent] : seen_) all.push_back(std::move(parent));
    return all;
  }

 private:
  std::map<std::uint32_t, ParentSeen> seen_;
};

}  // namespace

bool is_finite(const Sphere64& s) {
  return std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.radius);
}

bool Observed::finds(const Collisions& found, const Pair& pair) const {
  return std::ranges::binary_search(found.pairs, pair);
}

bool Observed::all_nodes_finite() const {
  return std::ranges::all_of(parents, [](const ParentSeen& p) { return is_finite(p.parent); });
}

Observer::Observer(const std::string& arithmetic)
    : format_(arithmetic == Double::name ? format_of<double>() : format_of<float>()),
      tree_(StrategyRegistry::instance().make("aCPU2+CPU2/" + arithmetic)),
      all_pairs_(StrategyRegistry::instance().make("CPU1/" + arithmetic)) {}

Observed Observer::of(Chain chain) {
  Observed result{format_, std::move(chain), {}, {}, {}, {}};
  result.exact = reference::all_pairs(result.chain).answer;
  for (auto [variant, found] :
       {std::pair{tree_.get(), &result.by_tree}, {all_pairs_.get(), &result.by_all_pairs}}) {
    variant->build(result.chain);
    variant->find(result.chain, {}, *found);
    std::ranges::sort(found->pairs);
  }
  Parents parents;
  tree_->visit_bounds(parents);
  result.parents = parents.take();
  return result;
}

}  // namespace catena::properties
