#include "catena/core/parts/group_boxes.h"

#include <cmath>

namespace catena::parts {
namespace {

/// The least and greatest of rounded ends, moved outward at the end and not one by one: rounding and
/// Box::around's move are monotone, so that the least, moved, is the least of those moved. Four numbers at a
/// time, as vectors take them; the fourth is of no use.
Box box_around(const Sphere* spheres, std::size_t count) {
  float low[4], high[4];
  const auto at = [](const Sphere& s, float(&c)[4]) { c[0] = s.x, c[1] = s.y, c[2] = s.z, c[3] = s.radius; };
  float centre[4];
  at(spheres[0], centre);
  for (int d = 0; d < 4; ++d) low[d] = centre[d] - centre[3], high[d] = centre[d] + centre[3];
  for (std::size_t k = 1; k < count; ++k) {
    at(spheres[k], centre);
    const float radius = centre[3];
    for (int d = 0; d < 4; ++d) {
      const float to_low = centre[d] - radius, to_high = centre[d] + radius;
      low[d] = to_low < low[d] ? to_low : low[d];
      high[d] = to_high > high[d] ? to_high : high[d];
    }
  }
  Box box;
  for (int d = 0; d < 3; ++d) {
    box.low[d] = low[d] - std::fabs(low[d]) * 0x1p-23f;
    box.high[d] = high[d] + std::fabs(high[d]) * 0x1p-23f;
  }
  return box;
}

}  // namespace

LargeVector<Box> group_boxes(std::span<const Sphere> spheres, std::uint32_t size, const Team& team) {
  constexpr std::uint32_t grain = 4096;
  LargeVector<Box> boxes((spheres.size() + size - 1) / size);
  team.for_each_range(
      static_cast<std::uint32_t>(boxes.size()), grain, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t g = begin; g < end; ++g) {
          const std::size_t first = std::size_t{g} * size;
          boxes[g] = box_around(spheres.data() + first, std::min<std::size_t>(size, spheres.size() - first));
        }
      });
  return boxes;
}

}  // namespace catena::parts
