#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "catena/bench/pivot/pivot.h"
#include "catena/bench/pivot/pivot_heap.h"
#include "catena/bench/pivot/symmetry.h"

namespace catena::bench {

/// The state of a PivotWalk.
struct WalkTree : PivotHeap {
  /// A box as x, y, z of its low end, then of its high end negated: a symmetry moves lanes and needs no sign,
  /// the join of two is their least, and two are apart where one's and the other's halves exchanged have a
  /// sum above 0. Lanes 3 and 7 are no part of it.
  using Lanes = std::array<std::int32_t, 8>;

  /// The two halves of a subwalk, both as the node sees them: from the point before it, turned in some way
  /// that its parents know. All that a search reads of them is one line of the cache.
  struct alignas(64) Halves {
    Lanes earlier;  ///< lanes 3 and 7: x and y of the earlier half's last point
    Lanes later;    ///< lane 3: its z; lane 7: how the later half is turned, by number

    LatticePoint earlier_end() const { return {earlier[3], earlier[7], later[3]}; }
    LatticeSymmetry later_turn() const { return LatticeSymmetry::number(later[7]); }
    void set(const LatticePoint& earlier_end, LatticeSymmetry later_turn) {
      earlier[3] = earlier_end.x, earlier[7] = earlier_end.y, later[3] = earlier_end.z;
      later[7] = later_turn.number();
    }
  };
  /// A point of a leaf as seen from the leaf: at most eight steps away.
  struct NearPoint {
    std::int8_t x, y, z, spare;
  };

  std::vector<Halves> halves;  ///< of inner nodes
  LatticePoint end;            ///< the last point, as the root sees it
  std::vector<NearPoint> near;
};

/// Makes the move, or the moves one after the other, where the walk stays self-avoiding; otherwise leaves it
/// as it was and says false.
bool attempt(WalkTree& tree, const Pivot& pivot);
bool attempt(WalkTree& tree, std::span<const Pivot> pivots);

}  // namespace catena::bench
