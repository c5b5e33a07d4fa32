#include "catena/bench/enumerate/walk.h"

#include <algorithm>

namespace catena::bench {

Walk Walk::then(int step) const {
  Walk longer = *this;
  longer.steps |= static_cast<std::uint64_t>(step) << (3 * length);
  ++longer.length;
  longer.axes_used = std::max(axes_used, static_cast<std::uint8_t>(step / 2 + 1));
  return longer;
}

std::uint64_t Walk::images(int dimensions) const {
  std::uint64_t images = 1;  // each axis used: one of those left, upwards or downwards
  for (int k = 0; k < axes_used; ++k) images *= 2 * static_cast<std::uint64_t>(dimensions - k);
  return images;
}

std::vector<std::array<int, 3>> Walk::points() const {
  std::vector<std::array<int, 3>> points{{0, 0, 0}};
  for (int k = 0; k < length; ++k) {
    std::array<int, 3> next = points.back();
    next[static_cast<std::size_t>(step(k) / 2)] += step(k) % 2 == 0 ? 1 : -1;
    points.push_back(next);
  }
  return points;
}

}  // namespace catena::bench
