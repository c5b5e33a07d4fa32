#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/core/hierarchy/bound.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// An axis-aligned box in binary32; its ends may be infinite.
struct Box {
  float low[3], high[3];

  /// A box that encloses the sphere, as a theorem. Of a rounded difference or sum v the true one is nearer
  /// than a step between floats. Where v is a normal number, |v| 2^-23 is at least that step, so v moved
  /// outward by it, and rounded, which is monotone, has passed the true one; where v is smaller the
  /// difference or sum was exact. properties/proofs/box_around_binary32.g.
  CATENA_HD static Box around(const Sphere& s) {
    Box box;
    const float centre[] = {s.x, s.y, s.z};
    for (int axis = 0; axis < 3; ++axis) {
      const float low = centre[axis] - s.radius, high = centre[axis] + s.radius;
      box.low[axis] = low - std::fabs(low) * 0x1p-23f;
      box.high[axis] = high + std::fabs(high) * 0x1p-23f;
    }
    return box;
  }

  /// What encloses nothing, and meets nothing, until a box joins it.
  static constexpr Box nothing() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  }

  void join(const Box& other) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }

  /// False only when a plane across an axis parts them.
  CATENA_HD bool meets(const Box& other) const {
    return (low[0] <= other.high[0]) & (other.low[0] <= high[0]) & (low[1] <= other.high[1]) &
           (other.low[1] <= high[1]) & (low[2] <= other.high[2]) & (other.low[2] <= high[2]);
  }

  Box64 shown() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
};

}  // namespace catena
