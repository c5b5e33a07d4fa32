#include "catena/core/hybrid/crowd_evidence.h"

namespace catena {
namespace {

constexpr std::uint32_t none = NodeParts::none, group = BlockTree::group;

}  // namespace

CrowdNodes::CrowdNodes(const ChainView& chain, const BlockTree& tree, const Crowding& crowding)
    : chain_(chain), tree_(tree), parts_(chain.size) {
  for (std::uint32_t b = 0; b < tree.blocks; ++b) {
    const bool crowded = crowding.crowded(b / group);
    for (std::uint32_t k = 0; k < BlockTree::block; ++k)
      if (const std::uint32_t i = tree.index(b, k); i != BlockTree::no_sphere)
        parts_[i] = NodeParts::one(i, crowded);
    parts_.push_back(NodeParts::one(chain.size + b, crowded));
  }
  end_id_ = chain.size + tree.blocks;
  for (const BlockTree::Level& level : tree.level) end_id_ += level.count;
  for (std::size_t l = 0; l < tree.level.size(); ++l) {
    const std::size_t below = parts_.size() - (l == 0 ? 0 : tree.level[l - 1].count);
    for (std::uint32_t k = 0; k < tree.level[l].count; ++k) {
      const auto id = static_cast<std::uint32_t>(parts_.size());
      if (l == 0) {
        parts_.push_back(NodeParts::one(id, crowding.crowded(k)));
        continue;
      }
      NodeParts of;
      for (std::uint32_t c = k * group; c < k * group + tree.children_of(l, k); ++c) {
        if (parts_[below + c].ours != none) of.ours = id;
        if (parts_[below + c].others != none && of.others == none) of.others = end_id_++;
      }
      parts_.push_back(of);
    }
  }
}

void CrowdNodes::show(BoundsVisitor& visitor) const {
  struct Parted final : BoundsVisitor {
    const CrowdNodes& nodes;
    BoundsVisitor& to;
    Parted(const CrowdNodes& of, BoundsVisitor& visitor) : nodes(of), to(visitor) {}
    void tree(const TreeFacts& facts) override { to.tree(facts); }
    void edge(std::uint32_t parent_id, const AnyBound& parent, std::uint32_t child_id,
              const AnyBound& child) override {
      const NodeParts &above = nodes.parts(parent_id), &below = nodes.parts(child_id);
      if (below.ours != none) to.edge(above.ours, parent, below.ours, child);
      if (below.others != none) to.edge(above.others, parent, below.others, child);
    }
  } parted(*this, visitor);
  show_blocks(chain_, tree_, parted);
}

void CrowdSink::discarded(std::uint32_t a, std::uint32_t b) {
  const NodeParts &p = nodes_.parts(a), &q = nodes_.parts(b);
  NodeParts::for_each_pair(p, q, [&](std::uint32_t x, std::uint32_t y) { sink_.discarded(x, y); });
  // Of spheres of one block or two that follow one another, which an order tells apart.
  if (p.ours == none && q.ours == none && nodes_.is_sphere(a) && nodes_.is_sphere(b) && !another_has(a, b))
    sink_.discarded(a, b);
}

void CrowdSink::compared(std::uint32_t a, std::uint32_t b) {
  NodeParts::for_each_pair(nodes_.parts(a), nodes_.parts(b),
                           [&](std::uint32_t x, std::uint32_t y) { sink_.compared(x, y); });
}

}  // namespace catena
