#include "catena/core/blocks/space_order.h"

#include <algorithm>

namespace catena {
namespace {

/// The ten lowest bits of v, two apart.
std::uint32_t spread(std::uint32_t v) {
  v = (v | v << 16) & 0x030000FF;
  v = (v | v << 8) & 0x0300F00F;
  v = (v | v << 4) & 0x030C30C3;
  return (v | v << 2) & 0x09249249;
}

}  // namespace

const std::vector<std::uint32_t>& SpaceOrder::of(const std::vector<Point>& points) {
  order_.resize(points.size());
  keys_.resize(points.size());
  if (points.empty()) return order_;
  Point low = points[0], high = points[0];
  for (const Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float side = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  const float cells = side > 0 ? 1023.0f / side : 0;
  const auto cell = [&](float v, float from) {
    return spread(static_cast<std::uint32_t>(std::min((v - from) * cells, 1023.0f)));
  };
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    const Point& p = points[k];
    const std::uint64_t place = cell(p.x, low.x) | cell(p.y, low.y) << 1 | cell(p.z, low.z) << 2;
    keys_[k] = place << 32 | k;
  }
  sort_(keys_.data(), keys_.size(), hwy::SortAscending());
  for (std::size_t k = 0; k < keys_.size(); ++k) order_[k] = static_cast<std::uint32_t>(keys_[k]);
  return order_;
}

}  // namespace catena
