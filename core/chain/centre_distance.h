#pragma once
#include <cmath>

#include "catena/core/sphere.h"

namespace catena {

/// How far the centres of two spheres are apart, in the user's unit, in binary64. Arc lengths and the lengths
/// of ways over joints are sums of this, in these very roundings: the exclusion rule compares the two.
inline double centre_distance(const Sphere& a, const Sphere& b) {
  const double dx = double{b.x} - a.x, dy = double{b.y} - a.y, dz = double{b.z} - a.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

}  // namespace catena
