#include "catena/core/grid/grid_evidence.h"

#include <algorithm>
#include <utility>

namespace catena {

GridTrees::GridTrees(const ChainView& chain, const SphereGrid& grid, std::uint32_t first_id)
    : chain_(chain), grid_(grid), first_id_(first_id), level_of_(chain.size) {
  for (std::size_t l = 0; l < grid.levels.size(); ++l) {
    std::vector<CellTree::Member> members;
    members.reserve(grid.levels[l].end - grid.levels[l].first);
    for (std::uint32_t at = grid.levels[l].first; at < grid.levels[l].end; ++at) {
      const std::uint32_t i = grid.member(at);
      level_of_[i] = static_cast<std::uint16_t>(l);
      members.push_back({place(i, l), i});
    }
    levels_.emplace_back(chain, std::move(members), end_id());
  }
}

CellPlace GridTrees::place(std::uint32_t sphere, std::size_t level) const {
  return CellPlace::of(chain_.spheres[sphere], grid_.levels[level].map.cells_per_unit, BucketMap::far_cell);
}

void GridTrees::show(BoundsVisitor& visitor) const {
  visitor.tree({});
  for (const CellTree& level : levels_) level.show(visitor);
}

GridEvidence::GridEvidence(const ChainView& chain, const GridTrees& trees, EvidenceSink& sink)
    : chain_(chain), trees_(trees), sink_(sink) {
  if (trees.levels() > 1) looks_.assign(trees.levels() - 1, std::vector<std::uint8_t>(chain.size, untold));
}

bool GridEvidence::next_to_one_another(std::uint32_t i, std::uint32_t j) const {
  const std::size_t level = std::min(trees_.level_of(i), trees_.level_of(j));
  return CellRange::of(trees_.place(i, level)).near(CellRange::of(trees_.place(j, level)));
}

void GridEvidence::rest() const {
  const auto apart = [&](std::uint32_t a, std::uint32_t b) { sink_.discarded(a, b); };
  for (std::size_t l = 0; l < trees_.levels(); ++l) {
    trees_.level(l).for_each_apart(apart, [](const CellTree::Node&, const CellTree::Node&) {});
    for (std::size_t coarser = 0; coarser < l; ++coarser) {
      const auto place = [&](std::uint32_t i) { return trees_.place(i, coarser); };
      const auto near = [&](std::uint32_t i, const CellPlace& at, const CellTree::Node& cell) {
        const std::uint8_t looks = looks_[coarser][i];
        if (looks == untold) return;
        bool left_out = looks == into_none;
        for (std::size_t d = 0; d < 3; ++d) {
          const std::int64_t on = cell.range.low.at[d] - at.at[d];
          left_out |= (on < 0 && (looks >> 2 * d & 1) == 0) || (on > 0 && (looks >> (2 * d + 1) & 1) == 0);
        }
        if (left_out) apart(i, cell.id);
      };
      trees_.level(l).for_each_apart(trees_.level(coarser), place, apart, near);
    }
  }
}

}  // namespace catena
