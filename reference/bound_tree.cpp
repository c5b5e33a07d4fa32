#include "catena/reference/bound_tree.h"

#include <algorithm>

#include "catena/reference/bounds.h"
#include "catena/reference/enclosure.h"

namespace catena::reference {
namespace {

/// Shown twice with the same numbers; NaN differs from itself and proves nothing.
bool same(const AnyBound& a, const AnyBound& b) {
  if (a.index() != b.index()) return false;
  if (const auto* slabs = std::get_if<Slabs64>(&a)) {
    const auto& others = std::get<Slabs64>(b);
    return slabs->origin == others.origin && std::ranges::equal(slabs->slabs, others.slabs);
  }
  return std::visit(
      [&](const auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Kind, Slabs64>)
          return false;
        else
          return kind == std::get<Kind>(b);
      },
      a);
}

}  // namespace

BoundTree::BoundTree(const Chain& chain) : chain_(chain), leaves_(chain.size()), nodes_(chain.size()) {
  for (std::uint32_t i = 0; i < leaves_; ++i) {
    const Sphere& s = chain[i];
    nodes_[i].sphere = {s.x, s.y, s.z, s.radius};
    nodes_[i].known = nodes_[i].is_sphere = true;
  }
}

void BoundTree::add(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
                    const AnyBound& child) {
  ++faults_.bounds;
  const bool placed = show(parent_id, parent) != nullptr && parent_id >= leaves_;
  Node* const node = show(child_id, child);
  const bool again = node != nullptr && node->parent != none;
  if (!placed || node == nullptr || (again && (child_id >= leaves_ || node->tree == trees_))) {
    ++faults_.misplaced;
    return;
  }
  if (again)
    further_.push_back({child_id, parent_id});
  else
    node->parent = parent_id;
  node->tree = trees_;
  ++nodes_[parent_id].open_children;
}

BoundTree::Node* BoundTree::show(std::uint32_t id, const AnyBound& bound) {
  if (id / 8 >= leaves_) return nullptr;
  if (id >= nodes_.size()) nodes_.resize(std::size_t{id} + 1);
  Node& node = nodes_[id];
  node.known = true;
  if (!store(node, bound)) ++(id < leaves_ ? faults_.foreign_leaves : faults_.misplaced);
  return &node;
}

/// False when the node has another bound already. Everything says nothing: the strategy stores no bound
/// there.
bool BoundTree::store(Node& node, const AnyBound& bound) {
  if (std::holds_alternative<Everything>(bound)) return true;
  const auto* sphere = std::get_if<Sphere64>(&bound);
  if (node.is_sphere) return sphere != nullptr && *sphere == node.sphere;
  if (node.other != none) return same(others_[node.other], bound);
  if (sphere != nullptr) {
    node.sphere = *sphere;
    node.is_sphere = true;
    return true;
  }
  node.other = static_cast<std::uint32_t>(others_.size());
  others_.push_back(bound);
  if (auto* slabs = std::get_if<Slabs64>(&others_.back())) {
    slabs_.emplace_back(slabs->slabs.begin(), slabs->slabs.end());
    slabs->slabs = slabs_.back();
  }
  return true;
}

AnyBound BoundTree::bound(const Node& node) const {
  if (node.is_sphere) return node.sphere;
  return node.other == none ? AnyBound(Everything{}) : others_[node.other];
}

std::optional<std::uint32_t> BoundTree::parent(std::uint32_t id) const {
  const std::uint32_t parent = nodes_[id].parent;
  return parent == none ? std::nullopt : std::optional(parent);
}

bool BoundTree::separate(std::uint32_t a, std::uint32_t b) const {
  const Node &p = nodes_[a], &q = nodes_[b];
  if (p.is_sphere && q.is_sphere) return reference::separate(p.sphere, q.sphere);
  return reference::separate(bound(p), bound(q));
}

void BoundTree::check(bool nested) {
  order();
  check_edges();
  if (nested) {
    for (Node& node : nodes_)
      if (node.parent != none && !node.nested)
        stick_out(node, node.is_sphere ? reference::shortfall(bound(nodes_[node.parent]), node.sphere) : 0);
    for (const Further& f : further_)
      if (!f.nested)
        stick_out(nodes_[f.sphere], reference::shortfall(bound(nodes_[f.parent]), nodes_[f.sphere].sphere));
  } else if (faults_.misplaced == 0) {  // a cycle would have no end
    check_spheres();
  }
}

void BoundTree::order() {
  std::uint64_t known = 0;
  for (std::uint32_t id = 0; id < nodes_.size(); ++id) {
    known += nodes_[id].known;
    if (nodes_[id].known && nodes_[id].open_children == 0) upwards_.push_back(id);
  }
  const auto settle = [&](std::uint32_t parent) {
    if (--nodes_[parent].open_children == 0) upwards_.push_back(parent);
  };
  for (const Further& f : further_) settle(f.parent);
  for (std::size_t k = 0; k < upwards_.size(); ++k) {
    const std::uint32_t parent = nodes_[upwards_[k]].parent;
    if (parent != none) settle(parent);
  }
  faults_.misplaced += known - upwards_.size();  // in a cycle
}

void BoundTree::check_edges() {
  for (Node& node : nodes_) {
    if (node.parent == none) continue;
    const Node& parent = nodes_[node.parent];
    node.nested = parent.is_sphere && node.is_sphere ? reference::encloses(parent.sphere, node.sphere)
                                                     : reference::encloses(bound(parent), bound(node));
  }
  for (Further& f : further_) f.nested = contains(bound(nodes_[f.parent]), nodes_[f.sphere].sphere);
}

void BoundTree::check_spheres() {
  if (!std::ranges::all_of(nodes_, [](const Node& node) { return node.parent == none || node.nested; }))
    for (std::uint32_t i = 0; i < leaves_; ++i)
      if (nodes_[i].parent != none)
        check_above(nodes_[i].sphere, nodes_[i], nodes_[i].parent, nodes_[i].nested);
  for (const Further& f : further_)
    check_above(nodes_[f.sphere].sphere, nodes_[f.sphere], f.parent, f.nested);
}

/// Holds a sphere against `parent`, which is that of `node`, and all above; what lies in a bound that lies in
/// the next lies in that, too.
void BoundTree::check_above(const Sphere64& sphere, Node& node, std::uint32_t parent, bool nested) {
  bool inside = true;  // of the node that the walk has reached
  for (Node* at = &node;; nested = at->nested, parent = at->parent) {
    if (!inside || !nested) {
      const AnyBound around = bound(nodes_[parent]);
      inside = contains(around, sphere);
      if (!inside) stick_out(*at, reference::shortfall(around, sphere));
    }
    at = &nodes_[parent];
    if (at->parent == none) return;
  }
}

void BoundTree::stick_out(Node& node, double shortfall) {
  faults_.unenclosed += !node.sticks_out;
  node.sticks_out = true;
  faults_.worst_shortfall = std::max(faults_.worst_shortfall, shortfall);
}

}  // namespace catena::reference
