#include "catena/core/space_tree/search_cost.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace catena {

double single_spheres_ns(const ChainView& chain, const BlockTree& tree, const Crowding& crowding) {
  constexpr double in_cells_ns = 50, in_space_ns = 75;
  constexpr std::uint32_t rare = 64;  // an octave of fewer costs next to nothing
  std::array<std::uint32_t, 64> octave{};
  std::uint32_t all = 0;
  const float greatest = chain.extent.greatest_radius;
  for (std::uint32_t node = 0; node < crowding.nodes(); ++node) {
    if (!crowding.crowded(node)) continue;
    // Not the same of all blocks: radii may come by turns.
    const std::uint32_t b = node * BlockTree::group;
    const float radius = tree.spheres(chain, b)[node % tree.size_of(b)].radius;
    const double share = greatest > 0 ? double{radius} / greatest : 1;
    const int below = share > 0 ? -std::ilogb(share) : static_cast<int>(octave.size()) - 1;
    ++octave[static_cast<std::size_t>(std::clamp(below, 0, static_cast<int>(octave.size()) - 1))];
    ++all;
  }
  const auto common = std::count_if(octave.begin(), octave.end(),
                                    [&](std::uint32_t spheres) { return spheres > all / rare; });
  return common > 1 ? in_space_ns : in_cells_ns;
}

}  // namespace catena
