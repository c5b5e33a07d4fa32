#include "catena/core/space_tree/search_cost.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace catena {

double grid_ns(const ChainView& chain, const BlockTree& tree, const Crowding& crowding) {
  constexpr double one_octave_ns = 50, more_ns = 45;
  constexpr std::uint32_t rare = 64;  // an octave of fewer costs next to nothing
  std::array<std::uint32_t, 64> octave{};
  std::uint32_t all = 0;
  const float greatest = chain.extent.greatest_radius;
  for (std::uint32_t node = 0; node < crowding.nodes(); ++node) {
    if (!crowding.crowded(node)) continue;
    const float radius = chain.spheres[tree.index(node * BlockTree::group, 0)].radius;
    const double share = greatest > 0 ? double{radius} / greatest : 1;
    const int below = share > 0 ? -std::ilogb(share) : static_cast<int>(octave.size()) - 1;
    ++octave[static_cast<std::size_t>(std::clamp(below, 0, static_cast<int>(octave.size()) - 1))];
    ++all;
  }
  const auto common = std::count_if(octave.begin(), octave.end(),
                                    [&](std::uint32_t spheres) { return spheres > all / rare; });
  return one_octave_ns + more_ns * static_cast<double>(std::max<std::ptrdiff_t>(0, common - 1));
}

}  // namespace catena
