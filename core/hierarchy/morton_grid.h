#pragma once
#include <algorithm>
#include <cstdint>

#include "catena/core/sphere.h"

namespace catena {

/// Morton codes of centres: 2^21 cubic cells along the longest side of a box that holds them all. In binary64, where no
/// difference overflows.
class MortonGrid {
 public:
  static constexpr int bits = 21;  ///< an axis

  /// The least and the greatest coordinates of all centres; radii do not matter.
  MortonGrid(const Sphere& low, const Sphere& high) : low_(low) {
    const double side = std::max({double{high.x} - low.x, double{high.y} - low.y, double{high.z} - low.z});
    if (side > 0) cells_ = ((1 << bits) - 1) / side;
  }

  std::uint64_t code(const Sphere& s) const {
    return spread(s.x, low_.x) << 2 | spread(s.y, low_.y) << 1 | spread(s.z, low_.z);
  }

 private:
  /// The cell along one axis, two zeros after each bit.
  std::uint64_t spread(float at, float low) const {
    auto v = static_cast<std::uint64_t>((double{at} - low) * cells_);
    v = (v | v << 32) & 0x001F00000000FFFF;
    v = (v | v << 16) & 0x001F0000FF0000FF;
    v = (v | v << 8) & 0x100F00F00F00F00F;
    v = (v | v << 4) & 0x10C30C30C30C30C3;
    return (v | v << 2) & 0x1249249249249249;
  }

  Sphere low_;
  double cells_ = 0;  ///< a unit of length
};

}  // namespace catena
