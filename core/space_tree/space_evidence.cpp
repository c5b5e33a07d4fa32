#include "catena/core/space_tree/space_evidence.h"

#include <algorithm>

#include "catena/core/blocks/block_evidence.h"

namespace catena {
namespace {

constexpr std::uint32_t group = SpaceTree::group;

}  // namespace

SpaceNodes::SpaceNodes(const ChainView& chain, const BlockTree& tree, const SpaceTree& space,
                       std::uint32_t first_id)
    : tree_(tree),
      space_(space),
      first_id_(first_id),
      end_id_(first_id + 2 * space.entries),
      entry_of_(chain.size, NodeParts::none) {
  for (std::uint32_t k = 0; k < space.entries; ++k)
    for (std::uint32_t j = 0; j < BlockTree::block; ++j)
      if (const std::uint32_t i = tree.index(space.block[k], j); i != BlockTree::no_sphere) entry_of_[i] = k;
  std::uint32_t below = space.entries;
  for (std::size_t l = 1; l < space.boxes.size(); ++l) {
    std::vector<NodeParts> level((below + group - 1) / group);
    for (std::uint32_t k = 0; k < below; ++k) {
      const NodeParts child = l == 1 ? box(k) : node(l - 1, k);
      NodeParts& parent = level[k / group];
      if (child.ours != NodeParts::none && parent.ours == NodeParts::none) parent.ours = end_id_++;
      if (child.others != NodeParts::none && parent.others == NodeParts::none) parent.others = end_id_++;
    }
    below = static_cast<std::uint32_t>(level.size());
    nodes_.push_back(std::move(level));
  }
}

/// Without half of the absolute slack that a box has: that is more than an origin far away rounds off here,
/// so that what boxes of the search part is apart, and what they hold is in them.
Box64 SpaceNodes::bound(std::size_t level, std::uint32_t k) const {
  const float* const f = space_.boxes_of(level, k / group) + k % group;
  const double unit = 1 / double{tree_.scale};
  const auto end = [&](std::uint32_t d, double slack) {
    return (space_.origin[d % 3] + (f[d * group] + slack)) * unit;
  };
  constexpr double slack = SpaceTree::tiny / 2;
  return {{end(0, slack), end(1, slack), end(2, slack)}, {end(3, -slack), end(4, -slack), end(5, -slack)}};
}

void SpaceNodes::show(BoundsVisitor& visitor) const {
  visitor.tree({});
  const auto edge = [&](const NodeParts& parent, const AnyBound& around, const NodeParts& child,
                        const AnyBound& bound) {
    if (child.ours != NodeParts::none) visitor.edge(parent.ours, around, child.ours, bound);
    if (child.others != NodeParts::none) visitor.edge(parent.others, around, child.others, bound);
  };
  for (std::size_t l = nodes_.size(); l > 0; --l) {
    const auto children = static_cast<std::uint32_t>(l == 1 ? space_.entries : nodes_[l - 2].size());
    for (std::uint32_t k = 0; k < children; ++k)
      edge(node(l, k / group), bound(l, k / group), l == 1 ? box(k) : node(l - 1, k), bound(l - 1, k));
  }
  for (std::uint32_t k = 0; k < space_.entries; ++k) {
    const Capsule64 around = shown_capsule(
        space_.capsules.data() + std::size_t{k} * BlockTree::capsule_fields, 1, 1 / double{tree_.scale});
    edge(box(k), bound(0, k), capsule(k), around);
    const NodeParts parent = capsule(k);
    for (std::uint32_t j = 0; j < BlockTree::block; ++j)
      if (const std::uint32_t i = tree_.index(space_.block[k], j); i != BlockTree::no_sphere)
        visitor.edge(std::min(parent.ours, parent.others), around, i, Everything{});
  }
}

}  // namespace catena
