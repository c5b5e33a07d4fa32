#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/bounds_visitor.h"

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
  /// The greatest side.
  std::int64_t side() const {
    std::int64_t side = 0;
    for (std::size_t d = 0; d < 3; ++d) side = std::max(side, high.at[d] - low.at[d]);
    return side;
  }
};

/// The cells that have spheres as leaves of a binary tree, whose nodes lie in boxes around their spheres: how
/// a search by cells, which has no tree, says in O(n) lines what it need not look at, cells that are not next
/// to one another. Its nodes have ids; that of a cell of one sphere is the sphere's. Of `size` spheres there
/// are fewer ids than spheres.
class CATENA_API CellTree {
 public:
  struct Member {
    CellPlace place;
    std::uint32_t sphere;
  };
  struct Node {
    CellRange range;
    Box64 box;
    std::uint32_t id;
    std::uint32_t first, end;  ///< of a cell: its members
    std::uint32_t right;       ///< the left child follows its parent; 0: a cell
  };

  /// The chain must outlive this; ids of nodes are first_id and following. O(c log c) for c cells.
  CellTree(const ChainView& chain, std::vector<Member> members, std::uint32_t first_id);

  bool empty() const { return nodes_.empty(); }
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
    if (!nodes_.empty()) within(0, apart, near);
  }

  /// Of spheres of this tree and of a coarser one, where place(sphere) is in the cells of that one. apart(id,
  /// id) as above; for each that are next to one another near(sphere, its place, node of the coarser).
  template <class Place, class Apart, class Near>
  void for_each_apart(const CellTree& coarser, const Place& place, const Apart& apart,
                      const Near& near) const {
    if (nodes_.empty() || coarser.empty()) return;
    std::vector<CellRange> range(nodes_.size());  // in the coarser cells
    for (std::size_t k = nodes_.size(); k-- > 0;) {
      const Node& node = nodes_[k];
      if (node.right != 0) {
        range[k] = range[k + 1];
        range[k].join(range[node.right]);
        continue;
      }
      range[k] = CellRange::of(place(members_[node.first].sphere));
      for (std::uint32_t m = node.first + 1; m < node.end; ++m)
        range[k].join(CellRange::of(place(members_[m].sphere)));
    }
    Against<Place, Apart, Near>{*this, coarser, range, place, apart, near}.nodes(0, 0);
  }

 private:
  struct Cell;
  Node leaf(const Cell& cell);
  void make(std::vector<Cell>& cells, std::uint32_t begin, std::uint32_t end);

  template <class Apart, class Near>
  void within(std::uint32_t k, const Apart& apart, const Near& near) const {
    if (nodes_[k].right == 0) return;
    within(k + 1, apart, near);
    within(nodes_[k].right, apart, near);
    between(k + 1, nodes_[k].right, apart, near);
  }
  template <class Apart, class Near>
  void between(std::uint32_t a, std::uint32_t b, const Apart& apart, const Near& near) const {
    const Node &p = nodes_[a], &q = nodes_[b];
    if (!p.range.near(q.range)) return apart(p.id, q.id);
    if (p.right == 0 && q.right == 0) return near(p, q);
    if (q.right == 0 || (p.right != 0 && p.range.side() > q.range.side())) {
      between(a + 1, b, apart, near);
      between(p.right, b, apart, near);
    } else {
      between(a, b + 1, apart, near);
      between(a, q.right, apart, near);
    }
  }

  template <class Place, class Apart, class Near>
  struct Against {
    const CellTree &fine, &coarser;
    const std::vector<CellRange>& range;
    const Place& place;
    const Apart& apart;
    const Near& near;

    void nodes(std::uint32_t a, std::uint32_t b) const {
      const Node &p = fine.nodes_[a], &q = coarser.nodes_[b];
      if (!range[a].near(q.range)) return apart(p.id, q.id);
      if (q.right != 0 && (p.right == 0 || q.range.side() >= range[a].side())) {
        nodes(a, b + 1);
        nodes(a, q.right);
      } else if (p.right != 0) {
        nodes(a + 1, b);
        nodes(p.right, b);
      } else {
        for (std::uint32_t m = p.first; m < p.end; ++m) {
          const std::uint32_t i = fine.members_[m].sphere;
          const CellPlace at = place(i);
          CellRange::of(at).near(q.range) ? near(i, at, q) : apart(i, q.id);
        }
      }
    }
  };

  const ChainView& chain_;
  std::vector<Member> members_;  ///< by cells
  std::vector<Node> nodes_;
  std::uint32_t end_id_;
};

}  // namespace catena
