#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/grid/sphere_grid.h"
#include "catena/core/hierarchy/cell_tree.h"
#include "catena/core/strategy/evidence.h"

namespace catena {

/// The cells of a SphereGrid as evidence names them: a CellTree for each level.
class CATENA_API GridTrees {
 public:
  /// Both must outlive this; ids of nodes are first_id and following, fewer than there are spheres.
  GridTrees(const ChainView& chain, const SphereGrid& grid, std::uint32_t first_id);

  std::uint32_t end_id() const { return levels_.empty() ? first_id_ : levels_.back().end_id(); }
  void show(BoundsVisitor& visitor) const;

  std::size_t levels() const { return levels_.size(); }
  const CellTree& level(std::size_t l) const { return levels_[l]; }
  std::size_t level_of(std::uint32_t sphere) const { return level_of_[sphere]; }
  /// Among the cells of a level.
  CellPlace place(std::uint32_t sphere, std::size_t level) const;
  std::uint32_t spheres() const { return chain_.size; }

 private:
  const ChainView& chain_;
  const SphereGrid& grid_;
  const std::uint32_t first_id_;
  std::vector<CellTree> levels_;
  std::vector<std::uint16_t> level_of_;  ///< [sphere]
};

/// What a search of a SphereGrid tells of itself. A pair of spheres in cells that are next to one another is
/// accounted for when the search compares it, or says that it need not; all others by rest(), whether they
/// were compared too, for cells share buckets, or not.
class CATENA_API GridEvidence {
 public:
  static constexpr bool listens = true;

  /// `chain` and `trees` must outlive this.
  GridEvidence(const ChainView& chain, const GridTrees& trees, EvidenceSink& sink);

  void compared(std::uint32_t i, std::uint32_t j) const {
    if (!next_to_one_another(i, j)) return;
    chain_.neighbours(i, j) ? sink_.excluded(i, j) : sink_.tested(i, j);
  }
  /// Spheres i and j were told from one another by the box of i and others.
  void apart(std::uint32_t i, std::uint32_t j) const {
    if (next_to_one_another(i, j)) sink_.discarded(i, j);
  }
  /// Sphere i of a finer level looks into cells around its own: bits 2 d and 2 d + 1 are set for those before
  /// and behind along axis d; or into none.
  static constexpr std::uint8_t into_none = 0x40;
  void looks(std::uint32_t i, std::size_t coarser, std::uint8_t cells) { looks_[coarser][i] = cells; }

  /// After the search: all that it had no need to look at.
  void rest() const;

 private:
  static constexpr std::uint8_t untold = 0x80;

  bool next_to_one_another(std::uint32_t i, std::uint32_t j) const;

  const ChainView& chain_;
  const GridTrees& trees_;
  EvidenceSink& sink_;
  std::vector<std::vector<std::uint8_t>> looks_;  ///< [coarser level][sphere]
};

/// Costs nothing.
struct NoGridEvidence {
  static constexpr bool listens = false;
};

}  // namespace catena
