#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/chain/chain_view.h"
#include "catena/core/frames/moved_cells.h"
#include "catena/core/frames/run_tree.h"
#include "catena/core/hierarchy/wide_box_tree.h"
#include "catena/core/pair.h"

namespace catena {

/// What searches of frames do in vectors, compiled once for each instruction set.

/// As RunTree::search.
void search_runs(const ChainView& chain, const RunRow& row, const WideBoxTree& tree, std::uint64_t most,
                 std::vector<Pair>& pairs);

/// Sets the boxes of runs first, ..., end - 1, which lie in the window as a whole, each around its spheres as
/// by Box::around.
void set_boxes_of_runs(const Sphere* places, std::uint32_t first, std::uint32_t end, WideBoxTree& tree);

/// Fills `places` with those of the pairs of which a sphere lies in a run that changed, ascending.
void find_pairs_of_runs(std::span<const Pair> pairs, const RunRow& row, std::vector<std::uint32_t>& places);

/// As MovedCells::search.
void search_cells(const ChainView& chain, const CellsOfFew& cells, std::uint64_t most,
                  std::vector<Pair>& pairs);

}  // namespace catena
