#pragma once
#include <array>
#include <boost/multiprecision/cpp_int.hpp>

#include "catena/core/periodic/periodic_box.h"
#include "catena/core/sphere.h"

namespace catena::properties {

using Rational = boost::multiprecision::cpp_rational;

/// The squared distance from the centre of a to that of the image of b that is `boxes` boxes away, exactly and
/// by no code of core/: the definition that searches in a box are held to.
inline Rational image_squared(const Sphere& a, const Sphere& b, const std::array<int, 3>& boxes,
                              const PeriodicBox& box) {
  const auto& [x, y, z] = boxes;
  const Rational dx = Rational(b.x) - Rational(a.x) + x * Rational(box.length[0]) + y * Rational(box.xy) +
                      z * Rational(box.xz),
                 dy = Rational(b.y) - Rational(a.y) + y * Rational(box.length[1]) + z * Rational(box.yz),
                 dz = Rational(b.z) - Rational(a.z) + z * Rational(box.length[2]);
  return dx * dx + dy * dy + dz * dz;
}

/// The least of all images up to `far` boxes away, along the edges that repeat. O(far^3).
inline Rational nearest_squared(const Sphere& a, const Sphere& b, const PeriodicBox& box, int far) {
  const auto reach = [&](std::size_t edge) { return box.length[edge] > 0 ? far : 0; };
  Rational least = -1;
  for (int x = -reach(0); x <= reach(0); ++x)
    for (int y = -reach(1); y <= reach(1); ++y)
      for (int z = -reach(2); z <= reach(2); ++z) {
        const Rational square = image_squared(a, b, {x, y, z}, box);
        if (least < 0 || square < least) least = square;
      }
  return least;
}

}  // namespace catena::properties
