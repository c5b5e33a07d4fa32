#pragma once
#include <cstdint>

#include "catena/core/blocks/block_tree.h"
#include "catena/core/chain/chain_view.h"

namespace catena {

/// Which stretches of a chain are all neighbours: by how far apart along the strand those spheres are that
/// lie furthest apart, and by the least radius, the rule itself says so, as arc lengths ascend and rounding
/// is monotone.
class NeighbourStretches {
 public:
  explicit NeighbourStretches(const ChainView& chain)
      : rule_(chain.exclusion),
        by_index_(rule_.rule == Exclusion::Rule::index_window),
        arc_(rule_.factor * (double{chain.extent.least_radius} + double{chain.extent.least_radius})),
        some_(by_index_ ? rule_.window + 1 >= BlockTree::block : arc_ > 0) {}

  /// Not false where a block's length may be one.
  bool some() const { return some_; }
  /// Every two spheres from i to j >= i are neighbours.
  bool all(std::uint32_t i, std::uint32_t j) const {
    if (!some_ || (!rule_.one_open_strand && rule_.strand_of[i] != rule_.strand_of[j])) return false;
    return by_index_ ? j - i <= rule_.window : rule_.arc[j] - rule_.arc[i] < arc_;
  }

 private:
  const ExclusionView& rule_;
  const bool by_index_;
  const double arc_;  ///< spheres nearer than that are neighbours, whatever their radii
  const bool some_;
};

/// Which blocks of a BlockTree have no spheres but neighbours: of a tube that is sampled far more finely than
/// it is thick, most blocks that are near one.
class NeighbourBlocks {
 public:
  NeighbourBlocks(const ChainView& chain, const BlockTree& tree) : tree_(tree), stretches_(chain) {}

  bool some() const { return stretches_.some(); }
  /// Every two spheres of block a and of block b >= a are neighbours, if they are not the same.
  bool all(std::uint32_t a, std::uint32_t b) const {
    return some() && stretches_.all(tree_.begin_of(a), tree_.end_of(b) - 1);
  }

  /// Of the blocks of group g from block a on, those that all() is true of.
  std::uint32_t lanes(std::uint32_t a, std::uint32_t g) const {
    constexpr std::uint32_t group = BlockTree::group;
    if (!some()) return 0;
    const std::uint32_t first = a > g * group ? a : g * group, last = g * group + tree_.blocks_of(g) - 1;
    std::uint32_t end = first;  // they follow one another
    if (all(a, last))
      end = last + 1;
    else
      while (all(a, end)) ++end;
    return ((1u << (end - first)) - 1) << (first - g * group);
  }

 private:
  const BlockTree& tree_;
  const NeighbourStretches stretches_;
};

}  // namespace catena
