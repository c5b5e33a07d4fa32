#include "catena/core/cells/blocks_evidence.h"

#include <cmath>
#include <limits>

#include "catena/core/blocks/block_evidence.h"

namespace catena {
namespace {

constexpr std::uint32_t none = NodeParts::none;

}  // namespace

CapsuleNodes::CapsuleNodes(const ChainView& chain, const CapsuleBlocks& blocks, std::uint32_t first_id)
    : spheres_(chain.size),
      blocks_(blocks),
      first_id_(first_id),
      end_id_(first_id + 2 * blocks.blocks),
      tree_(leaves(), end_id_) {
  const std::vector<Tree::Node>& nodes = tree_.nodes();
  parts_.resize(nodes.size());
  for (std::size_t k = nodes.size(); k-- > 0;) {
    if (nodes[k].is_leaf()) {
      parts_[k] = NodeParts::one(nodes[k].id, blocks.crowded(nodes[k].first));
      continue;
    }
    const NodeParts &left = parts_[k + 1], &right = parts_[nodes[k].right];
    if (left.ours != none || right.ours != none) parts_[k].ours = nodes[k].id;
    if (left.others != none || right.others != none) parts_[k].others = end_id_++;
  }
}

std::vector<CapsuleNodes::Tree::Node> CapsuleNodes::leaves() const {
  std::vector<Tree::Node> leaves;
  leaves.reserve(2 * std::size_t{blocks_.blocks});
  for (std::uint32_t b = 0; b < blocks_.blocks; ++b) {
    const BoxRange range = box(b);
    leaves.push_back({range, range.box, first_id_ + b, b, b + 1});
  }
  return leaves;
}

Capsule64 CapsuleNodes::capsule(std::uint32_t block) const {
  const BlockCapsule& c = blocks_.capsule[block];
  const float fields[] = {c.centre.x, c.centre.y, c.centre.z, c.half.x, c.half.y, c.half.z, c.radius};
  return shown_capsule(fields, 1, 1 / double{blocks_.scale});
}

/// Around the capsule as it is shown; a step farther out than it is rounded.
BoxRange CapsuleNodes::box(std::uint32_t block) const {
  const Capsule64 c = capsule(block);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto low = [&](double a, double b) { return std::nextafter(std::min(a, b) - c.radius, -infinity); };
  const auto high = [&](double a, double b) { return std::nextafter(std::max(a, b) + c.radius, infinity); };
  return {{{low(c.a.x, c.b.x), low(c.a.y, c.b.y), low(c.a.z, c.b.z)},
           {high(c.a.x, c.b.x), high(c.a.y, c.b.y), high(c.a.z, c.b.z)}}};
}

void CapsuleNodes::show(BoundsVisitor& visitor) const {
  visitor.tree({});
  const auto edge = [&](const Tree::Node& parent, const Tree::Node& child) {
    const NodeParts &above = parts(parent), &below = parts(child);
    if (below.ours != none) visitor.edge(above.ours, parent.box, below.ours, child.box);
    if (below.others != none) visitor.edge(above.others, parent.box, below.others, child.box);
  };
  for (const Tree::Node& node : tree_.nodes()) {
    if (!node.is_leaf()) {
      edge(node, tree_.children(node).first);
      edge(node, tree_.children(node).second);
      continue;
    }
    const std::uint32_t b = node.first, first = b * CapsuleBlocks::block;
    const Capsule64 around = capsule(b);
    visitor.edge(node.id, node.box, capsule_id(b), around);
    for (std::uint32_t i = first; i < std::min(first + CapsuleBlocks::block, spheres_); ++i)
      visitor.edge(capsule_id(b), around, i, Everything{});
  }
}

void CapsuleEvidence::met(std::uint32_t a, std::uint32_t near_a, std::uint32_t b, std::uint32_t near_b) {
  if (!nodes_.near(a, b)) return;
  met_.insert(key(a, b));
  for_each_in(a, ~near_a, [&](std::uint32_t i) { sink_.discarded(i, nodes_.capsule_id(b)); });
  for_each_in(b, ~near_b, [&](std::uint32_t j) {
    for_each_in(a, near_a, [&](std::uint32_t i) { sink_.discarded(i, j); });
  });
}

void CapsuleEvidence::compared(std::uint32_t i, std::uint32_t j) const {
  if (i / block != j / block && !nodes_.near(i / block, j / block)) return;
  chain_.neighbours(i, j) ? sink_.excluded(i, j) : sink_.tested(i, j);
}

/// Blocks a and b, the same one or the next, that are certified to go on in order: of spheres that are no
/// more than the window apart those of one strand's window are neighbours, and others were compared.
void CapsuleEvidence::in_order(std::uint32_t a, std::uint32_t b) const {
  const bool neighbours = chain_.strand_count == 1 && chain_.exclusion.rule == Exclusion::Rule::index_window;
  for_each_in(a, ~0u, [&](std::uint32_t i) {
    for_each_in(b, ~0u, [&](std::uint32_t j) {
      if (j > i + blocks_.window)
        sink_.discarded(i, j);
      else if (j > i && neighbours)
        sink_.excluded(i, j);
    });
  });
}

void CapsuleEvidence::rest() const {
  using Node = CapsuleNodes::Tree::Node;
  for (std::uint32_t b = 0; b < blocks_.blocks; ++b)
    if (blocks_.ordered(b) && !blocks_.crowded(b)) in_order(b, b);
  const auto apart = [&](const Node& p, const Node& q) {
    NodeParts::for_each_pair(nodes_.parts(p), nodes_.parts(q),
                             [&](std::uint32_t x, std::uint32_t y) { sink_.discarded(x, y); });
  };
  nodes_.tree().for_each_pair(apart, [&](const Node& p, const Node& q) {
    const std::uint32_t a = std::min(p.first, q.first), b = std::max(p.first, q.first);
    if (blocks_.crowded(a) && blocks_.crowded(b)) return;
    if (b == a + 1 && blocks_.ordered(a)) return in_order(a, b);
    if (!met_.contains(key(a, b))) sink_.discarded(nodes_.capsule_id(a), nodes_.capsule_id(b));
  });
}

}  // namespace catena
