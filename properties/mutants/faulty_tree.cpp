#include "catena/properties/mutants/faulty_tree.h"

#include <algorithm>
#include <stdexcept>

#include "catena/core/arithmetic/robust.h"
#include "catena/core/error.h"

namespace catena::properties {

void FaultyTree::build(const Chain& chain) {
  tree_ = storage_.reset(chain.size());
  std::fill_n(tree_.bound, tree_.size(), Sphere{});  // what a bug leaves unwritten is the same each time
  std::fill_n(tree_.links, tree_.size(), Links{});
  std::ranges::copy(chain.spheres(), tree_.bound);
  if (chain.size() > 0) construct();
}

void FaultyTree::construct() {
  Level level = Level::leaves(tree_.leaves);
  std::uint32_t next = tree_.leaves;
  while (level.size > 1) {
    for (std::uint32_t p = 0; p < level.pairs(); ++p)
      join(next + p, {level.node(2 * p), level.node(2 * p + 1)});
    const std::uint32_t parents = level.pairs();
    level = level.above(next);
    next += parents;
  }
  tree_.root = level.node(0);
}

void FaultyTree::join(std::uint32_t slot, const Links& children) {
  tree_.links[slot] = children;
  tree_.bound[slot] = parent(tree_.bound[children.left], tree_.bound[children.right]);
}

void FaultyTree::start(const Chain& chain, const Request& request) {
  if (tree_.leaves != chain.size()) throw std::logic_error("find: not the chain of the last build");
  queries_ = request.queries;
  counts_.assign(chain.size(), 0);
  pairs_.clear();
}

void FaultyTree::find(const Chain& chain, const Request& request, Collisions& result) {
  start(chain, request);
  for (std::uint32_t i = 0; i < chain.size(); ++i) search(chain.view(), i);
  answer(request, result);
}

void FaultyTree::search(const ChainView& chain, std::uint32_t i) { below(chain, i, tree_.root); }

void FaultyTree::below(const ChainView& chain, std::uint32_t i, std::uint32_t slot) {
  if (tree_.is_leaf(slot)) return leaf(chain, i, slot);
  const Links children = tree_.links[slot];
  if (children == Links{} || !descend(tree_.bound[i], tree_.bound[slot])) return;
  below(chain, i, children.left);
  below(chain, i, children.right);
}

void FaultyTree::leaf(const ChainView& chain, std::uint32_t i, std::uint32_t j) {
  if (i != j && !neighbours(chain, i, j) && collide(chain, i, j)) hit(i, j);
}

Sphere FaultyTree::parent(const Sphere& a, const Sphere& b) const { return Robust::parent(a, b); }
bool FaultyTree::descend(const Sphere& query, const Sphere& node) const {
  return Robust::may_overlap(query, node);
}
bool FaultyTree::neighbours(const ChainView& chain, std::uint32_t i, std::uint32_t j) const {
  return chain.neighbours(i, j);
}
bool FaultyTree::collide(const ChainView& chain, std::uint32_t i, std::uint32_t j) const {
  return Robust::overlap(chain.spheres[i], chain.spheres[j]);
}

void FaultyTree::hit(std::uint32_t i, std::uint32_t j) {
  if (!queries_.contains(i)) return;
  ++counts_[i];
  if (i < j) pairs_.push_back({i, j});
}

void FaultyTree::answer(const Request& request, Collisions& result) {
  result.found = !pairs_.empty();
  result.pair_count = pairs_.size();
  result.count.assign(counts_.begin(), request.want == Request::Want::any ? counts_.begin() : counts_.end());
  result.pairs.clear();
  if (request.want != Request::Want::pairs) return;
  if (pairs_.size() > request.pair_limit) throw PairLimitExceeded(pairs_.size(), request.pair_limit);
  result.pairs = pairs_;
}

void FaultyTree::visit_bounds(BoundsVisitor& visitor) const {
  const auto shown = [&](std::uint32_t slot) {
    const Sphere& s = tree_.bound[slot];
    return Sphere64{s.x, s.y, s.z, s.radius};
  };
  visitor.tree({.nested = true});
  for (std::uint32_t slot = tree_.leaves; slot < tree_.size(); ++slot)
    for (const std::uint32_t child : {tree_.links[slot].left, tree_.links[slot].right})
      if (child != Links::none) visitor.edge(slot, shown(slot), child, shown(child));
}

}  // namespace catena::properties
