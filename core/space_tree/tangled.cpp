#include "catena/core/space_tree/tangled.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "catena/core/hierarchy/morton_grid.h"
#include "catena/core/scattered.h"

namespace catena {
namespace {

bool meet(const CentreCorners& a, const CentreCorners& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace

bool tangled(const ChainView& chain) {
  constexpr std::uint32_t stretch = 128, of_each = 8, fewest = 12, most = 256, next_to_it = 2;
  constexpr double others = 2.8;
  const std::uint32_t stretches = chain.size / stretch;
  if (stretches == 0) return false;
  const auto samples = std::clamp(static_cast<std::uint32_t>(3 * std::sqrt(double(stretches))), fewest, most);
  std::array<CentreCorners, most> boxes;
  std::array<std::uint32_t, most> which;
  std::uint32_t met = 0;
  for (std::uint32_t k = 0; k < samples; ++k) {
    which[k] = scattered(k + 1, stretches);
    for (std::uint32_t j = 0; j < of_each; ++j)
      boxes[k].take(chain.spheres[which[k] * stretch + j * (stretch / of_each)]);
    for (std::uint32_t j = 0; j < k; ++j)
      met += meet(boxes[k], boxes[j]) &&
             std::max(which[k], which[j]) > std::min(which[k], which[j]) + next_to_it;
  }
  return 2.0 * met * stretches > others * samples * samples;
}

}  // namespace catena
