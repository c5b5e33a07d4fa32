#include "catena/core/cells/cells_evidence.h"

#include <algorithm>
#include <utility>

namespace catena {

CellsTrees::CellsTrees(const ChainView& chain, const SphereCells& cells,
                       std::span<const std::uint32_t> spheres, std::uint32_t first_id)
    : chain_(chain), first_id_(first_id), level_of_(chain.size), number_(Octaves::count) {
  const auto octave = [&](std::uint32_t i) {
    return cells.one_level() ? 0 : cells.octaves.of(chain.spheres[i].radius);
  };
  std::vector<std::vector<CellTree::Member>> members(Octaves::count);
  for (const std::uint32_t i : spheres) members[octave(i)].push_back({{}, i});
  for (std::uint32_t k = 0; k < Octaves::count; ++k) {
    if (members[k].empty()) continue;
    const auto level = static_cast<std::uint16_t>(levels_.size());
    number_[k] = level;
    cells_per_unit_.push_back(cells.cells_per_unit * Octaves::cells_of(k));
    for (auto& [at, i] : members[k]) {
      level_of_[i] = level;
      at = place(i, level);
    }
    levels_.emplace_back(chain, std::move(members[k]), end_id());
  }
}

CellPlace CellsTrees::place(std::uint32_t sphere, std::size_t level) const {
  return CellPlace::of(chain_.spheres[sphere], cells_per_unit_[level], BucketMap::far_cell);
}

void CellsTrees::show(BoundsVisitor& visitor) const {
  visitor.tree({});
  for (const CellTree& level : levels_) level.show(visitor);
}

CellsEvidence::CellsEvidence(const ChainView& chain, const CellsTrees& trees, EvidenceSink& sink)
    : chain_(chain),
      trees_(trees),
      sink_(sink),
      looks_(trees.levels().size(), std::vector<std::uint32_t>(chain.size)) {}

void CellsEvidence::compared(std::uint32_t i, std::uint32_t j, std::uint32_t octave) const {
  // Buckets are shared by levels, and by cells that have nothing to do with one another.
  const std::size_t level = trees_.level_of_octave(octave);
  if (trees_.level_of(j) != level) return;
  if (!CellRange::of(trees_.place(i, level)).near(CellRange::of(trees_.place(j, level)))) return;
  chain_.neighbours(i, j) ? sink_.excluded(i, j) : sink_.tested(i, j);
}

std::uint32_t CellsEvidence::bit(const CellPlace& from, const CellPlace& to) {
  const auto along = [&](std::size_t d) { return static_cast<std::uint32_t>(to.at[d] - from.at[d] + 1); };
  return along(0) + 3 * along(1) + 9 * along(2);
}

void CellsEvidence::rest() const {
  constexpr std::uint32_t own = 13;  // the bits above it are of the half that comes after a cell
  const auto apart = [&](std::uint32_t a, std::uint32_t b) { sink_.discarded(a, b); };
  for (std::size_t l = 0; l < trees_.levels().size(); ++l) {
    const CellTree& tree = trees_.levels()[l];
    tree.for_each_apart(apart, [&](const CellTree::Node& a, const CellTree::Node& b) {
      const std::uint32_t on = bit(a.range.low, b.range.low);
      const CellTree::Node &first = on > own ? a : b, &second = on > own ? b : a;
      const std::uint32_t look = bit(first.range.low, second.range.low);
      tree.for_each_in(first, [&](std::uint32_t i) {
        if (left_out(i, l, look)) tree.for_each_in(second, [&](std::uint32_t j) { apart(i, j); });
      });
    });
    for (std::size_t coarser = 0; coarser < l; ++coarser) {
      const CellTree& other = trees_.levels()[coarser];
      const auto near = [&](std::uint32_t i, const CellPlace& at, const CellTree::Node& cell) {
        if (left_out(i, coarser, bit(at, cell.range.low)))
          other.for_each_in(cell, [&](std::uint32_t j) { apart(i, j); });
      };
      tree.for_each_apart(
          other, [&](std::uint32_t i) { return trees_.place(i, coarser); }, apart, near);
    }
  }
}

}  // namespace catena
