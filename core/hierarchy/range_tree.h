#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "catena/core/hierarchy/bound.h"

namespace catena {

/// A binary tree over things that have a range each, parted across the longest side of what they fill: how
/// evidence of a search without such a tree says in few lines which of them are not near. A Range has
/// join(range), near(range), side() and side(d), and middle(d), of three axes d.
template <class Range>
class RangeTree {
 public:
  struct Node {
    Range range;
    Box64 box;                 ///< around what is below it
    std::uint32_t id;          ///< of a leaf as it was given
    std::uint32_t first, end;  ///< of a leaf as they were given
    std::uint32_t right = 0;   ///< the left child follows its parent; 0: a leaf
    bool is_leaf() const { return right == 0; }
  };

  /// Inner nodes take ids from `next_id` on. O(n log n) for ranges that are not all in one place.
  RangeTree(std::vector<Node> leaves, std::uint32_t& next_id) {
    nodes_.reserve(2 * leaves.size());
    if (!leaves.empty()) make(leaves, 0, leaves.size(), next_id);
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  std::pair<const Node&, const Node&> children(const Node& parent) const {
    return {*(&parent + 1), nodes_[parent.right]};
  }

  /// apart(node, node) for pairs of nodes that are not near, near(node, node) for pairs of leaves that are;
  /// every pair of different leaves is below one of the former or is one of the latter, once.
  template <class Apart, class Near>
  void for_each_pair(const Apart& apart, const Near& near) const {
    for (const Node& node : nodes_)
      if (!node.is_leaf()) between(children(node).first, children(node).second, apart, near);
  }

  /// The box that holds both.
  static void join(Box64& box, const Box64& other) {
    box.low = {std::min(box.low.x, other.low.x), std::min(box.low.y, other.low.y),
               std::min(box.low.z, other.low.z)};
    box.high = {std::max(box.high.x, other.high.x), std::max(box.high.y, other.high.y),
                std::max(box.high.z, other.high.z)};
  }

 private:
  void make(std::vector<Node>& leaves, std::size_t begin, std::size_t end, std::uint32_t& next_id) {
    if (end - begin == 1) return nodes_.push_back(leaves[begin]);
    const std::size_t at = nodes_.size();
    Node inner = leaves[begin];
    for (std::size_t k = begin + 1; k < end; ++k)
      inner.range.join(leaves[k].range), join(inner.box, leaves[k].box);
    std::size_t axis = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (inner.range.side(d) > inner.range.side(axis)) axis = d;
    const auto from = leaves.begin() + static_cast<std::ptrdiff_t>(begin),
               to = leaves.begin() + static_cast<std::ptrdiff_t>(end);
    auto second = std::partition(from, to, [&, middle = inner.range.middle(axis)](const Node& leaf) {
      return leaf.range.middle(axis) <= middle;
    });
    if (second == from || second == to) second = from + (to - from) / 2;
    const auto parted = static_cast<std::size_t>(second - leaves.begin());
    inner.id = next_id++;
    nodes_.push_back(inner);
    make(leaves, begin, parted, next_id);
    nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
    make(leaves, parted, end, next_id);
  }

  template <class Apart, class Near>
  void between(const Node& p, const Node& q, const Apart& apart, const Near& near) const {
    if (!p.range.near(q.range)) return apart(p, q);
    if (p.is_leaf() && q.is_leaf()) return near(p, q);
    if (q.is_leaf() || (!p.is_leaf() && p.range.side() > q.range.side())) {
      between(children(p).first, q, apart, near);
      between(children(p).second, q, apart, near);
    } else {
      between(p, children(q).first, apart, near);
      between(p, children(q).second, apart, near);
    }
  }

  std::vector<Node> nodes_;
};

}  // namespace catena
