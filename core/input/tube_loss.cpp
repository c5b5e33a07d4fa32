#include "catena/core/input/tube_loss.h"

#include <algorithm>
#include <cmath>

#include "catena/core/scenes/step_between.h"

namespace catena {
double tube_loss(std::span<const Sphere> spheres) {
  const Sphere &a = spheres.front(), &b = spheres.back();
  const Vec3 chord = step_between(a, b);
  const double squared = dot(chord, chord);
  double excess = 0, reach = std::sqrt(squared), greatest = std::max(a.radius, b.radius);
  for (const Sphere& sphere : spheres.subspan(1, spheres.size() - 2)) {
    const Vec3 out = step_between(a, sphere);
    const double along = squared > 0 ? std::clamp(dot(out, chord) / squared, 0.0, 1.0) : 0.0;
    const double here = a.radius + along * (double{b.radius} - a.radius);
    excess = std::max(excess, length(out - along * chord) + sphere.radius - here);
    reach = std::max(reach, length(out));
    greatest = std::max(greatest, double{sphere.radius});
  }
  const double radius = std::min(a.radius, b.radius), taper = double{a.radius} - b.radius;
  // Some ten operations round, each by 2^-53 of a length that is at most reach + greatest; where the root is
  // small its argument has lost digits, so that a dip near the radius is not told from it.
  const double quarter = std::max(0.0, squared * (1 + 1e-14) - taper * taper * (1 - 1e-14)) / 4;
  if (quarter >= radius * radius) return greatest;
  const double dip = quarter / (radius + std::sqrt(radius * radius - quarter));
  if (dip > 0.999 * radius) return greatest;
  return std::min(greatest, excess + dip * (1 + 1e-12) + 4e-15 * (reach + greatest));
}

}  // namespace catena
