#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/pair.h"
#include "catena/core/sphere.h"

namespace catena {

/// Cells of the places where a centre can be of a sphere that touches one of a few; plain pointers.
struct CellsOfFew {
  Box around;                         ///< all those places
  std::array<float, 3> scale, last;   ///< a cell of a coordinate is (at - low) scale, at most last
  std::array<std::uint32_t, 3> step;  ///< from cell to cell along an axis
  const std::uint32_t* filled;        ///< a bit a cell: it has entries
  const std::uint32_t* begin;         ///< of each cell, in entries
  const std::uint32_t* entries;       ///< the few, in each cell that they reach
  const Sphere* spheres;              ///< of the entries; seven more may be read
  const std::uint32_t* is_few;        ///< a bit a sphere of the chain
};

/// Finds the pairs of a few spheres of a chain with all others by going through the chain once: the places
/// where a centre can be of a sphere that touches one of the few are laid into cells, and each sphere looks
/// into the cell of its own. For crowded chains, whose order says little; elsewhere a tree takes less.
class CATENA_API MovedCells {
 public:
  virtual ~MovedCells() = default;

  /// Lays out the spheres `moved`, indices of the chain, ascending. O(moved + n / 32) and at most 2^18 cells
  /// to set to zero. False, and of no use, where a box has no end or more than 64 entries a sphere would be
  /// made.
  virtual bool lay_out(const ChainView& chain, std::span<const std::uint32_t> moved);
  /// Appends each colliding pair with one of them, once, lower index first. O(n) and the entries of the cells
  /// that are looked into; after a lay_out of this chain that was true. Ends soon after there are more than
  /// `most`.
  void search(const ChainView& chain, std::vector<Pair>& pairs,
              std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) const;

 protected:
  /// How far from the centre of one of the few a centre is at most whose sphere touches it. A test may break
  /// it.
  virtual float reach(const Sphere& s, float greatest_radius) const;
  /// As the search is to have it.
  virtual CellsOfFew view() const;

 private:
  static constexpr std::uint32_t most_along = 64;  ///< cells of an axis

  /// Of a coordinate. Each step rounds monotonically, so that what lies between two coordinates has a cell
  /// between theirs: no constant is needed.
  std::uint32_t along(std::size_t axis, float at) const {
    const float cell = (at - around_.low[axis]) * scale_[axis];
    return static_cast<std::uint32_t>(cell < 0 ? 0 : cell > last_[axis] ? last_[axis] : cell);
  }
  template <class Visit>
  void for_each_cell(const Box& box, const Visit& visit) const;

  Box around_{};  ///< all boxes
  std::array<float, 3> scale_{}, last_{};
  std::array<std::uint32_t, 3> step_{};
  std::vector<Box> boxes_;              ///< where a centre may be, of each moved one
  std::vector<std::uint32_t> begin_;    ///< of each cell, in entries_
  std::vector<std::uint32_t> entries_;  ///< spheres
  std::vector<Sphere> spheres_;         ///< the same
  std::vector<std::uint32_t> filled_, is_few_;
};

}  // namespace catena
