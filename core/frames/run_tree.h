#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/pair.h"
#include "catena/core/sphere.h"

namespace catena {

/// A frame's spheres as a window of a row of places, in *runs* of eight consecutive ones. A frame that is
/// shifted moves the window on: a place keeps its run.
struct RunRow {
  const Sphere* places;                    ///< as many as all runs have
  std::uint32_t begin, end;                ///< the window: place begin + i is sphere i
  const std::uint8_t* is_changed;          ///< of each run
  std::span<const std::uint32_t> changed;  ///< those runs, ascending
};

/// Boxes over runs, and a tree over them. For the few runs that change from frame to frame; a whole chain is
/// searched otherwise.
class CATENA_API RunTree {
 public:
  static constexpr std::uint32_t run = 8;

  /// Makes room for a row of so many places, all of them empty. Allocates nothing when it has not grown.
  void clear(std::uint32_t places) { tree_.clear((places + run - 1) / run); }
  /// Boxes of runs first, ..., end - 1 and of all that is above them. O(runs), and a path to the root.
  void refresh(const RunRow& row, std::uint32_t first, std::uint32_t end);

  /// Appends each colliding pair of the chain with a sphere of a run that changed, once, lower index first.
  /// The tree is that of the row, whose window are the chain's spheres. Ends soon after there are more than
  /// `most`.
  void search(const ChainView& chain, const RunRow& row, std::uint64_t most, std::vector<Pair>& pairs) const;

 private:
  WideBoxTree tree_;
};

}  // namespace catena
