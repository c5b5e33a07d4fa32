#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/cells/sphere_cells.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/cell_tree.h"
#include "catena/core/strategy/evidence.h"

namespace catena {

/// The cells of a SphereCells as evidence names them: a CellTree for each level.
class CATENA_API CellsTrees {
 public:
  /// `spheres` are those that were sorted. The chain must outlive this; ids of nodes are first_id and
  /// following, fewer than there are spheres.
  CellsTrees(const ChainView& chain, const SphereCells& cells, std::span<const std::uint32_t> spheres,
             std::uint32_t first_id);

  std::uint32_t end_id() const { return levels_.empty() ? first_id_ : levels_.back().end_id(); }
  void show(BoundsVisitor& visitor) const;

  const std::vector<CellTree>& levels() const { return levels_; }
  /// By its number among those that have spheres, coarse ones first; that of a sphere, and of an octave.
  std::size_t level_of(std::uint32_t sphere) const { return level_of_[sphere]; }
  std::size_t level_of_octave(std::uint32_t octave) const { return number_[octave]; }
  /// Among the cells of a level.
  CellPlace place(std::uint32_t sphere, std::size_t level) const;

 private:
  const ChainView& chain_;
  const std::uint32_t first_id_;
  std::vector<CellTree> levels_;
  std::vector<double> cells_per_unit_;   ///< [level]
  std::vector<std::uint16_t> level_of_;  ///< [sphere]
  std::vector<std::uint16_t> number_;    ///< [octave]
};

/// What a search of a SphereCells tells of itself; as GridEvidence does.
class CATENA_API CellsEvidence {
 public:
  /// All must outlive this.
  CellsEvidence(const ChainView& chain, const CellsTrees& trees, EvidenceSink& sink);

  /// Sphere i was compared with j, which lies in a bucket of a cell of that octave.
  void compared(std::uint32_t i, std::uint32_t j, std::uint32_t octave) const;
  /// Sphere i looks into these of the 27 cells around its own of that octave: bit (x + 1) + 3 (y + 1) +
  /// 9 (z + 1).
  void looks(std::uint32_t i, std::uint32_t octave, std::uint32_t cells) {
    looks_[trees_.level_of_octave(octave)][i] |= cells | told;
  }
  /// After the search: all that it had no need to look at.
  void rest() const;

 private:
  static constexpr std::uint32_t told = 1u << 27;
  static std::uint32_t bit(const CellPlace& from, const CellPlace& to);
  /// Sphere i was to look into that cell, and need not; it may hold spheres of its own level or finer ones.
  bool left_out(std::uint32_t i, std::size_t level, std::uint32_t bit) const {
    const std::uint32_t looks = looks_[level][i];
    return (looks & told) != 0 && (looks >> bit & 1) == 0;
  }

  const ChainView& chain_;
  const CellsTrees& trees_;
  EvidenceSink& sink_;
  std::vector<std::vector<std::uint32_t>> looks_;  ///< [level][sphere]
};

}  // namespace catena
