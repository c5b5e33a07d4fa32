#pragma once
#include <bit>
#include <cstdint>
#include <span>

#include "catena/core/export.h"
#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/sphere.h"

namespace catena {

/// Boxes over *runs* of eight consecutive places of a row, and a tree over them. The spheres of a frame are a window of
/// the row, which a frame that is shifted moves on: a place keeps its run. For the few runs that change from frame to
/// frame; a whole chain is searched otherwise.
class CATENA_API RunTree {
 public:
  static constexpr std::uint32_t run = 8;

  /// Makes room for a row of so many places, all of them empty. Allocates nothing when it has not grown.
  void clear(std::uint32_t places) { tree_.clear((places + run - 1) / run); }
  /// Boxes of runs first, ..., end - 1 and of all that is above them. `row` are all places, of which those of
  /// the window [begin, end) are spheres. O(runs), and a path to the root.
  void refresh(const Sphere* row, std::uint32_t window_begin, std::uint32_t window_end, std::uint32_t first,
               std::uint32_t end);

  static constexpr std::uint32_t together = WideBoxTree::fan;  ///< runs that share a box above

  /// visit(r, other) for each r of `runs`, all of one `together`, and every run whose box meets that of r,
  /// itself among them; empty runs meet none. What is far from all of them is left out once.
  template <class Visit>
  void for_each_near(std::span<const std::uint32_t> runs, const Visit& visit) const {
    Box around = tree_.box(runs.front());
    for (const std::uint32_t r : runs) around.join(tree_.box(r));
    tree_.for_each_group_near(around, [&](std::uint32_t group) {
      for (const std::uint32_t r : runs)
        for (std::uint32_t bits = tree_.meeting_in_group(group, tree_.box(r)); bits != 0; bits &= bits - 1)
          visit(r, group * together + static_cast<std::uint32_t>(std::countr_zero(bits)));
    });
  }

 private:
  WideBoxTree tree_;
};

}  // namespace catena
