#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/bounds_visitor.h"
#include "catena/core/hierarchy/range_tree.h"

namespace catena {

/// The place of a point among cells of space, such that points whose places differ by more than 1 in a
/// coordinate are more than a cell apart. Numbers are those of the cells near the origin; farther out, where
/// floats lie more than a cell apart, each float is a cell of its own, and next to none.
struct CellPlace {
  std::array<std::int64_t, 3> at;

  /// Cells of 1 / cells_per_unit, numbered up to `far`, at most 2^38.
  static CellPlace of(const Sphere& s, double cells_per_unit, double far);
  friend bool operator==(const CellPlace&, const CellPlace&) = default;
};

/// Places low to high, in each coordinate.
struct CellRange {
  CellPlace low, high;

  static CellRange of(const CellPlace& place) { return {place, place}; }
  void join(const CellRange& other) {
    for (std::size_t d = 0; d < 3; ++d) {
      low.at[d] = std::min(low.at[d], other.low.at[d]);
      high.at[d] = std::max(high.at[d], other.high.at[d]);
    }
  }
  /// Some cell of this one may be, or be next to, some of the other.
  bool near(const CellRange& other) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (low.at[d] - other.high.at[d] > 1 || other.low.at[d] - high.at[d] > 1) return false;
    return true;
  }
  std::int64_t side(std::size_t d) const { return high.at[d] - low.at[d]; }
  std::int64_t side() const { return std::max({side(0), side(1), side(2)}); }
  std::int64_t middle(std::size_t d) const { return low.at[d] + side(d) / 2; }
};

/// The cells that have spheres as leaves of a RangeTree: how a search by cells, which has no tree, says in
/// O(n) lines what it need not look at, cells that are not next to one another. Its nodes lie in boxes around
/// their spheres and have ids; that of a cell of one sphere is the sphere's. There are fewer ids than
/// spheres.
class CATENA_API CellTree {
 public:
  struct Member {
    CellPlace place;
    std::uint32_t sphere;
  };
  /// `first` and `end` of a cell are its members.
  using Node = RangeTree<CellRange>::Node;

  /// The chain must outlive this; ids of nodes are first_id and following. O(c log c) for c cells.
  CellTree(const ChainView& chain, std::vector<Member> members, std::uint32_t first_id);

  std::uint32_t end_id() const { return end_id_; }
  void show(BoundsVisitor& visitor) const;
  /// body(sphere) for those of a cell.
  template <class Body>
  void for_each_in(const Node& cell, const Body& body) const {
    for (std::uint32_t m = cell.first; m < cell.end; ++m) body(members_[m].sphere);
  }

  /// apart(id, id) for pairs of nodes whose cells are not next to one another, so that every pair of spheres
  /// in such cells is below one of them; near(node, node) for each two cells that are.
  template <class Apart, class Near>
  void for_each_apart(const Apart& apart, const Near& near) const {
    tree_.for_each_pair([&](const Node& a, const Node& b) { apart(a.id, b.id); }, near);
  }

  /// Of spheres of this tree and of a coarser one, where place(sphere) is in the cells of that one. apart(id,
  /// id) as above; for each that are next to one another near(sphere, its place, node of the coarser).
  template <class Place, class Apart, class Near>
  void for_each_apart(const CellTree& coarser, const Place& place, const Apart& apart,
                      const Near& near) const {
    const std::vector<Node>& nodes = tree_.nodes();
    if (nodes.empty() || coarser.tree_.nodes().empty()) return;
    std::vector<CellRange> range(nodes.size());  // in the coarser cells
    for (std::size_t k = nodes.size(); k-- > 0;) {
      if (nodes[k].is_leaf()) {
        range[k] = CellRange::of(place(members_[nodes[k].first].sphere));
        for_each_in(nodes[k], [&](std::uint32_t i) { range[k].join(CellRange::of(place(i))); });
      } else {
        range[k] = range[k + 1];
        range[k].join(range[nodes[k].right]);
      }
    }
    Against<Place, Apart, Near>{*this, coarser, range, place, apart, near}.nodes(0, 0);
  }

 private:
  template <class Place, class Apart, class Near>
  struct Against {
    const CellTree &fine, &coarser;
    const std::vector<CellRange>& range;
    const Place& place;
    const Apart& apart;
    const Near& near;

    void nodes(std::uint32_t a, std::uint32_t b) const {
      const Node &p = fine.tree_.nodes()[a], &q = coarser.tree_.nodes()[b];
      if (!range[a].near(q.range)) return apart(p.id, q.id);
      if (!q.is_leaf() && (p.is_leaf() || q.range.side() >= range[a].side())) {
        nodes(a, b + 1);
        nodes(a, q.right);
      } else if (!p.is_leaf()) {
        nodes(a + 1, b);
        nodes(p.right, b);
      } else {
        fine.for_each_in(p, [&](std::uint32_t i) {
          const CellPlace at = place(i);
          CellRange::of(at).near(q.range) ? near(i, at, q) : apart(i, q.id);
        });
      }
    }
  };

  std::vector<Node> cells(const ChainView& chain);

  std::vector<Member> members_;  ///< by cells
  std::uint32_t end_id_;
  RangeTree<CellRange> tree_;
};

}  // namespace catena
