#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// Two zeros after each of the 21 lowest bits.
CATENA_HD inline std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 32) & 0x001F00000000FFFF;
  v = (v | v << 16) & 0x001F0000FF0000FF;
  v = (v | v << 8) & 0x100F00F00F00F00F;
  v = (v | v << 4) & 0x10C30C30C30C30C3;
  return (v | v << 2) & 0x1249249249249249;
}

/// The least and the greatest coordinates of some centres; radii are 0.
struct CentreCorners {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  Sphere low{infinity, infinity, infinity, 0}, high{-infinity, -infinity, -infinity, 0};

  void take(const Sphere& s) { join({s, s}); }
  /// The point between the corners that is nearest to a centre, which is itself mostly.
  Sphere nearest(const Sphere& s) const {
    return {std::clamp(s.x, low.x, high.x), std::clamp(s.y, low.y, high.y), std::clamp(s.z, low.z, high.z),
            0};
  }
  void join(const CentreCorners& c) {
    low = {std::min(low.x, c.low.x), std::min(low.y, c.low.y), std::min(low.z, c.low.z), 0};
    high = {std::max(high.x, c.high.x), std::max(high.y, c.high.y), std::max(high.z, c.high.z), 0};
  }
};

/// Morton codes of centres: 2^21 cubic cells along the longest side of a box that holds them all. In
/// binary64, where no difference overflows.
class MortonGrid {
 public:
  static constexpr int bits = 21;  ///< an axis

  explicit MortonGrid(const CentreCorners& c) : low_(c.low) {
    const double side = std::max({double{c.high.x} - c.low.x, double{c.high.y} - c.low.y, double{c.high.z} - c.low.z});
    if (side > 0) cells_ = ((1 << bits) - 1) / side;
  }
  explicit MortonGrid(std::span<const Sphere> spheres) : MortonGrid(corners_of(spheres)) {}

  /// All centres are one: every code is 0.
  bool is_point() const { return cells_ == 0; }

  std::uint64_t code(const Sphere& s) const {
    return spread(s.x, low_.x) << 2 | spread(s.y, low_.y) << 1 | spread(s.z, low_.z);
  }

 private:
  static CentreCorners corners_of(std::span<const Sphere> spheres) {
    CentreCorners corners;
    for (const Sphere& s : spheres) corners.take(s);
    return corners;
  }
  /// The cell along one axis, two zeros after each bit.
  std::uint64_t spread(float at, float low) const {
    return spread_bits(static_cast<std::uint64_t>((double{at} - low) * cells_));
  }

  Sphere low_;
  double cells_ = 0;  ///< a unit of length
};

}  // namespace catena
