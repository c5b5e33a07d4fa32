#pragma once
#include <cmath>

#include "catena/core/hierarchy/radius_range.h"
#include "catena/core/host_device.h"
#include "catena/core/sphere.h"

namespace catena {

/// The paper's formulas as printed (Section 4.1 and inequality (2)), in one floating-point format, round to
/// nearest. The one reading applied: the garbled centre means c3 = c1 + (r3 - r1) * gamma. Its flaws are kept
/// on purpose: `<=` for the radius and `<` for the centre make two equal spheres at one place 0/0, the radius
/// is rounded to nearest so parents need not enclose, and squares overflow and underflow.
template <class Real, class BoundType>
struct PaperFormulas {
  using Bound = BoundType;

  CATENA_HD static Bound bound(const Sphere& s) { return {Real(s.x), Real(s.y), Real(s.z), Real(s.radius)}; }

  /// Inequality (2): |cA - cB|^2 <= (rA + rB)^2.
  CATENA_HD static bool overlap(const Bound& a, const Bound& b) {
    const Real dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.radius + b.radius;
    return dx * dx + dy * dy + dz * dz <= reach * reach;
  }
  CATENA_HD static bool separate(const Bound& a, const Bound& b) { return !overlap(a, b); }
  CATENA_HD static bool may_overlap(const Bound& query, const Bound& node) { return overlap(query, node); }

  /// The paper checks no range.
  static bool in_range(const RadiusRange& /*radii*/) { return true; }

  /// Equation (1), Fig. 7: the parent of two spheres.
  CATENA_HD static Bound parent(const Bound& a, const Bound& b) {
    using std::sqrt;
    const Real dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
    const Real d = sqrt(dx * dx + dy * dy + dz * dz);
    const Bound& smaller = a.radius < b.radius ? a : b;
    const Bound& greater = a.radius < b.radius ? b : a;
    const Real r3 = d + smaller.radius <= greater.radius ? greater.radius : (d + a.radius + b.radius) / 2;
    if (d + smaller.radius < greater.radius) return {greater.x, greater.y, greater.z, r3};
    const Real gx = dx / d, gy = dy / d, gz = dz / d, advance = r3 - a.radius;
    return {a.x + advance * gx, a.y + advance * gy, a.z + advance * gz, r3};
  }
};

/// The paper in binary32: what its authors ran.
struct Literal : PaperFormulas<float, Sphere> {
  static constexpr const char* name = "literal";
  static constexpr bool exact = false;  ///< whether pairs are those of exact real arithmetic
  using InRange = Literal;
};

/// The paper in binary64.
struct Double : PaperFormulas<double, Sphere64> {
  static constexpr const char* name = "double";
  static constexpr bool exact = false;  ///< whether pairs are those of exact real arithmetic
  using InRange = Double;
};

}  // namespace catena
