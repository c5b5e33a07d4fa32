#pragma once
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "catena/core/periodic/periodic_box.h"
#include "catena/core/sphere.h"

namespace catena::properties {

using Rational = boost::multiprecision::cpp_rational;

/// The squared distance from the centre of a to that of the image of b that is `boxes` boxes away, exactly
/// and by no code of core/: the definition that searches in a box are held to.
inline Rational image_squared(const Sphere& a, const Sphere& b, const std::array<int, 3>& boxes,
                              const PeriodicBox& box) {
  const auto& [x, y, z] = boxes;
  const Rational dx = Rational(b.x) - Rational(a.x) + x * Rational(box.length[0]) + y * Rational(box.xy) +
                      z * Rational(box.xz),
                 dy = Rational(b.y) - Rational(a.y) + y * Rational(box.length[1]) + z * Rational(box.yz),
                 dz = Rational(b.z) - Rational(a.z) + z * Rational(box.length[2]);
  return dx * dx + dy * dy + dz * dz;
}

/// That distance in binary64, and a bound of its error: each of twelve terms and sums is off by 2^-53 of them
/// at most.
inline std::array<double, 2> rough_distance(const Sphere& a, const Sphere& b, const std::array<int, 3>& boxes,
                                            const PeriodicBox& box) {
  const auto& [x, y, z] = boxes;
  const double dx = double{b.x} - a.x + x * box.length[0] + y * box.xy + z * box.xz,
               dy = double{b.y} - a.y + y * box.length[1] + z * box.yz,
               dz = double{b.z} - a.z + z * box.length[2],
               most = std::abs(a.x) + std::abs(a.y) + std::abs(a.z) + std::abs(b.x) + std::abs(b.y) +
                      std::abs(b.z) + std::abs(x * box.length[0]) + std::abs(y * box.xy) +
                      std::abs(z * box.xz) + std::abs(y * box.length[1]) + std::abs(z * box.yz) +
                      std::abs(z * box.length[2]);
  return {std::hypot(dx, dy, dz), 0x1p-40 * most};
}

/// The least of all images up to `far` boxes away, along the edges that repeat. O(far^3); what lies farther
/// than another beyond any rounding is not looked at exactly, which would take a minute for thousands.
inline Rational nearest_squared(const Sphere& a, const Sphere& b, const PeriodicBox& box, int far) {
  const auto reach = [&](std::size_t edge) { return box.length[edge] > 0 ? far : 0; };
  Rational least = -1;
  double enough = std::numeric_limits<double>::infinity();
  for (int x = -reach(0); x <= reach(0); ++x)
    for (int y = -reach(1); y <= reach(1); ++y)
      for (int z = -reach(2); z <= reach(2); ++z) {
        const auto [distance, error] = rough_distance(a, b, {x, y, z}, box);
        if (distance - error > enough) continue;
        enough = std::min(enough, distance + error);
        const Rational square = image_squared(a, b, {x, y, z}, box);
        if (least < 0 || square < least) least = square;
      }
  return least;
}

}  // namespace catena::properties
