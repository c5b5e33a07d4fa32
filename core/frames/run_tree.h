#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/sphere.h"

namespace catena {

/// Boxes over *runs* of eight consecutive places of a row, of sixteen runs each, and so on to one. The
/// spheres of a frame are a window of the row, which a frame that is shifted moves on: a place keeps its run.
/// For the few runs that change from frame to frame; a whole chain is searched otherwise.
class CATENA_API RunTree {
 public:
  static constexpr std::uint32_t run = 8, fan = 16;

  /// Makes room for a row of so many places, all of them empty. Allocates nothing when it has not grown.
  void clear(std::uint32_t places);
  /// Boxes of runs first, ..., end - 1 and of all that is above them. `row` are all places, of which those of
  /// the window [begin, end) are spheres. O(runs), and a path to the root.
  void refresh(const Sphere* row, std::uint32_t window_begin, std::uint32_t window_end, std::uint32_t first,
               std::uint32_t end);

  /// visit(run) for every run whose box meets that of this one, itself among them; empty runs meet none.
  template <class Visit>
  void for_each_near(std::uint32_t of, const Visit& visit) const {
    if (levels_.empty()) return;
    descend(levels_.size() - 1, 0, box_of(of), visit);
  }

 private:
  /// Sixteen boxes, a coordinate after the other.
  struct Group {
    std::array<std::array<float, fan>, 3> low, high;
  };

  Box box_of(std::uint32_t of) const;
  void set(std::size_t level, std::uint32_t node, const Box& box);
  static Box around(const Group& group);

  /// Bit k: box k meets this one. An axis at a time, as vectors take it.
  static std::uint32_t meeting(const Group& g, const Box& box) {
    std::array<std::uint32_t, fan> apart{};
    for (int d = 0; d < 3; ++d)
      for (std::uint32_t k = 0; k < fan; ++k)
        apart[k] |= std::uint32_t{g.low[d][k] > box.high[d]} | std::uint32_t{box.low[d] > g.high[d][k]};
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < fan; ++k) bits |= (apart[k] ^ 1u) << k;
    return bits;
  }

  template <class Visit>
  void descend(std::size_t level, std::uint32_t group, const Box& box, const Visit& visit) const {
    const std::uint32_t bits = meeting(levels_[level][group], box);
    for (std::uint32_t k = 0; k < fan; ++k) {
      if ((bits >> k & 1) == 0) continue;
      const std::uint32_t child = group * fan + k;
      level == 0 ? visit(child) : descend(level - 1, child, box, visit);
    }
  }

  std::vector<std::vector<Group>> levels_;  ///< groups of runs, of groups, and so on; the last is one group
};

}  // namespace catena
