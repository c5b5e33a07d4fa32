#include "catena/core/parts/group_boxes.h"

#include <algorithm>
#include <cmath>

namespace catena::parts {

/// The least and greatest of rounded ends, moved outward at the end and not one by one: rounding and
/// Box::around's move are monotone, so that the least, moved, is the least of those moved. Four numbers at a
/// time, as vectors take them; the fourth is of no use.
Box box_around(std::span<const Sphere> spheres) {
  float low[4], high[4], centre[4];
  const auto read = [&](const Sphere& s) {
    centre[0] = s.x, centre[1] = s.y, centre[2] = s.z, centre[3] = s.radius;
  };
  read(spheres[0]);
  for (int d = 0; d < 4; ++d) low[d] = centre[d] - centre[3], high[d] = centre[d] + centre[3];
  for (const Sphere& s : spheres.subspan(1)) {
    read(s);
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

void enclose_groups(std::span<const Sphere> spheres, std::uint32_t size, Box* boxes) {
  for (std::size_t first = 0; first < spheres.size(); first += size)
    *boxes++ = box_around(spheres.subspan(first, std::min<std::size_t>(size, spheres.size() - first)));
}

LargeVector<Box> group_boxes(std::span<const Sphere> spheres, std::uint32_t size, const Team& team) {
  constexpr std::uint32_t grain = 4096;
  LargeVector<Box> boxes((spheres.size() + size - 1) / size);
  team.for_each_range(static_cast<std::uint32_t>(boxes.size()), grain,
                      [&](std::uint32_t begin, std::uint32_t end) {
                        const std::size_t first = std::size_t{begin} * size,
                                          last = std::min(std::size_t{end} * size, spheres.size());
                        enclose_groups(spheres.subspan(first, last - first), size, boxes.data() + begin);
                      });
  return boxes;
}

}  // namespace catena::parts
