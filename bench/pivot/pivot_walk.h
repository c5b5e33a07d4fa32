#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/bench/pivot/walk_tree.h"
#include "catena/core/chain/chain.h"

namespace catena::bench {

/// A self-avoiding walk on the cubic lattice under pivots, after Clisby's SAW-tree (J. Stat. Phys. 140,
/// 2010): a binary tree over the walk whose nodes hold a box and, lazily, the symmetry of their later half;
/// its leaves are runs of at most eight points. A pivot costs O(log n) but for the search for a collision,
/// which ends at the first one and looks nearest to the pivot first. Memory 12 to 20 bytes a point.
class PivotWalk {
 public:
  /// A straight walk. Throws InputError unless it has 2 to 2^30 points.
  explicit PivotWalk(std::uint32_t points);

  std::uint32_t size() const { return tree_.size; }
  std::size_t bytes() const;  ///< of memory that its state takes
  /// Makes the move where the walk stays self-avoiding; otherwise leaves the walk as it was and says false.
  bool attempt(const Pivot& pivot) { return bench::attempt(tree_, pivot); }
  /// The same for several moves at once, one after the other: all are made, or none. O(k log n), and the
  /// search.
  bool attempt(std::span<const Pivot> pivots);

  LatticePoint end_to_end() const;
  std::vector<LatticePoint> points() const;  ///< the first is the origin; O(n)
  /// The walk as a chain like any other: spheres of this radius, in steps. For radius < 1/2 it collides just
  /// where the walk meets itself. Throws InputError where a coordinate is beyond 2^24, which binary32 may not
  /// hold.
  Chain chain(float radius) const;

 private:
  WalkTree tree_;
};

}  // namespace catena::bench
