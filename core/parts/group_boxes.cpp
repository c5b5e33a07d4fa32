#include "catena/core/parts/group_boxes.h"

#include <algorithm>

#include "catena/core/hierarchy/box_around.h"

namespace catena::parts {

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
