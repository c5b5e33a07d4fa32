#pragma once
#include <limits>
#include <span>
#include <vector>

#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/ranks/communicator.h"

namespace catena::ranks {

/// A box around nothing.
constexpr Box nowhere() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}
/// Whether a box is around something.
inline bool is_somewhere(const Box& box) { return box.low[0] <= box.high[0]; }

/// The box around all that each rank holds. What meets no other rank's touches nothing there: only of the
/// rest more is told.
class Regions {
 public:
  /// All ranks call it, each with its own; nowhere() of a rank without spheres. O(ranks) memory.
  static Regions of_all(Communicator& ranks, const Box& own);

  const Box& own() const { return own_; }
  /// The other ranks whose regions meet it, ascending.
  std::span<const unsigned> neighbours() const { return neighbours_; }
  /// Whether something of this rank in this box may touch another rank.
  bool may_touch_others(const Box& box) const { return others_.meets(box); }

 private:
  Box own_{};
  std::vector<unsigned> neighbours_;
  WideBoxTree others_;  ///< theirs
};

}  // namespace catena::ranks
