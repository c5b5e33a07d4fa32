#pragma once
#include <cmath>

#include "catena/core/sphere.h"

namespace catena {

/// How deep two spheres overlap, ri + rj less the distance of their centres, and how near the decision is to
/// changing, |q - t| / t with q the squared distance and t = (ri + rj)^2; rounded to double. For people: what
/// collides is decided exactly, elsewhere.
struct Overlap {
  double depth, margin;
};

inline Overlap overlap_of(const Sphere& a, const Sphere& b) {
  const long double dx = static_cast<long double>(a.x) - b.x, dy = static_cast<long double>(a.y) - b.y,
                    dz = static_cast<long double>(a.z) - b.z,
                    touch = static_cast<long double>(a.radius) + b.radius;
  const long double distance = std::hypot(dx, dy, dz), depth = touch - distance;
  // |q - t| = |distance - touch| (distance + touch), without the loss of a difference of squares.
  const long double margin = depth == 0 ? 0 : std::abs(depth) * (distance + touch) / (touch * touch);
  return {static_cast<double>(depth), static_cast<double>(margin)};
}

}  // namespace catena
