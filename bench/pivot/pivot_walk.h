#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/bench/pivot/symmetry.h"
#include "catena/core/chain/chain.h"

namespace catena::bench {

/// One move of the pivot algorithm: every point after `site` is turned about it.
struct Pivot {
  std::uint32_t site;  ///< 0 to points - 2
  LatticeSymmetry turn;
};

/// A self-avoiding walk on the cubic lattice under pivots, after Clisby's SAW-tree (J. Stat. Phys. 140,
/// 2010): a binary tree over the walk whose nodes hold a box and, lazily, the symmetry of their later half;
/// its leaves are runs of at most eight points. A pivot costs O(log n) but for the search for a collision,
/// which ends at the first one and looks nearest to the pivot first. Memory 11 to 19 bytes a point.
class PivotWalk {
 public:
  /// A straight walk. Throws InputError unless it has 2 to 2^30 points.
  explicit PivotWalk(std::uint32_t points);

  std::uint32_t size() const { return size_; }
  /// Makes the move where the walk stays self-avoiding; otherwise leaves the walk as it was and says false.
  bool attempt(const Pivot& pivot);
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
  static constexpr std::uint32_t most_in_leaf = 8;

  /// The two halves of a subwalk, each as seen from the point before it and turned in some way that its
  /// parents know. All that a search reads of them is one line of the cache.
  struct alignas(64) Halves {
    LatticeBounds earlier_box, later_box;
    LatticePoint earlier_end;    ///< the last point of the earlier half
    LatticeSymmetry later_turn;  ///< of the later half, as seen from the earlier one
  };
  /// A point of a leaf as seen from the leaf: at most eight steps away.
  struct NearPoint {
    std::int8_t x, y, z;
  };
  /// Points of the walk where they are in space: all below a node, or some of a leaf's.
  struct Part {
    std::uint32_t node;
    std::uint32_t begin, end;  ///< read of a leaf only
    LatticeMove at;
    LatticeBounds box;
  };
  struct Cut;

  // Nodes as in a heap: 1 is the root, 2k and 2k + 1 are below k, the last level are the leaves.
  bool is_leaf(std::uint32_t node) const { return node >= leaves_; }
  std::uint32_t first_point(std::uint32_t leaf) const {
    return static_cast<std::uint32_t>(std::uint64_t{leaf - leaves_} * size_ / leaves_);
  }
  std::uint32_t leaf_of(std::uint32_t point) const;
  std::uint32_t first_below(std::uint32_t node) const;
  std::uint32_t end_below(std::uint32_t node) const;
  LatticePoint near(std::uint32_t point) const;

  Part root() const;
  Part half(std::uint32_t node, const LatticeMove& at, const LatticeBounds& box) const;
  Part some_of(std::uint32_t leaf, std::uint32_t begin, std::uint32_t end, const LatticeMove& at) const;
  Part earlier(std::uint32_t node, const LatticeMove& at) const;
  Part later(std::uint32_t node, const LatticeMove& at) const;
  LatticeMove at_later(std::uint32_t node, const LatticeMove& at) const;
  LatticePoint later_end(std::uint32_t node, const LatticePoint& end) const;
  Part moved(const Part& part, const LatticeMove& move) const;

  bool meet(const Part& before, const Part& after) const;
  bool points_meet(const Part& before, const Part& after) const;
  bool meets_itself(const Part& part, std::span<const Pivot> sorted) const;
  Cut cut(std::uint32_t site) const;
  void turn(const Cut& cut, LatticeSymmetry turn);

  std::uint32_t size_, leaves_ = 1;
  std::vector<Halves> halves_;  ///< of inner nodes
  LatticePoint end_;            ///< of the root
  std::vector<NearPoint> near_;
  std::vector<Part> before_, after_;  ///< of the attempt under way
};

}  // namespace catena::bench
