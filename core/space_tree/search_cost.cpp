#include "catena/core/space_tree/search_cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "catena/core/space_tree/mean_near.h"

namespace catena {
namespace {

/// So many are looked at, of so many that there are: more where it costs less.
std::uint32_t samples_of(std::uint32_t spheres, std::uint32_t all) {
  constexpr std::uint32_t fewest = 4, most = 32, apart = 256;
  return std::min(all, std::clamp(spheres / apart, fewest, most));
}

using Samples = std::array<std::uint32_t, 32>;

SingleSpheres cheaper(const ChainView& chain, std::span<const std::uint32_t> samples, bool cells) {
  constexpr double ball = 4.0 / 3 * std::numbers::pi / 27;  // of what is told to be near, within reach
  const double near = mean_near(chain, samples), in_space = SingleSphereCost::in_space(near),
               in_cells = SingleSphereCost::in_cells(near), pairs = ball * near / 2;
  return cells && in_cells < in_space ? SingleSpheres{true, in_cells, pairs}
                                      : SingleSpheres{false, in_space, pairs};
}

/// Of one sphere of each crowded node.
bool one_octave(const ChainView& chain, const BlockTree& tree, const Crowding& crowding) {
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
    // The greatest are of the octave below them.
    const int below = share >= 1 ? 1 : share > 0 ? -std::ilogb(share) : static_cast<int>(octave.size()) - 1;
    ++octave[static_cast<std::size_t>(std::clamp(below, 0, static_cast<int>(octave.size()) - 1))];
    ++all;
  }
  const auto common = std::count_if(octave.begin(), octave.end(),
                                    [&](std::uint32_t spheres) { return spheres > all / rare; });
  return common <= 1;
}

}  // namespace

SingleSpheres single_spheres(const ChainView& chain) {
  Samples samples;
  const std::uint32_t count = samples_of(chain.size, chain.size);
  for (std::uint64_t k = 0; k < count; ++k)
    samples[k] = static_cast<std::uint32_t>((2 * k + 1) * chain.size / (2 * count));
  return cheaper(chain, {samples.data(), count}, true);
}

SingleSpheres single_spheres(const ChainView& chain, const BlockTree& tree, const Crowding& crowding) {
  Samples samples;
  const std::uint32_t crowded = crowding.crowded_nodes(), count = samples_of(chain.size, crowded);
  std::uint32_t found = 0;
  for (std::uint32_t node = 0, seen = 0; node < crowding.nodes() && found < count; ++node) {
    if (!crowding.crowded(node)) continue;
    if (std::uint64_t{seen++} * count < std::uint64_t{found} * crowded) continue;
    const std::uint32_t b = tree.some_block_of(node);
    samples[found++] = tree.begin_of(b) + tree.size_of(b) / 2;
  }
  return cheaper(chain, {samples.data(), found}, one_octave(chain, tree, crowding));
}

}  // namespace catena
