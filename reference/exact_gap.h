#pragma once
#include <cmath>

#include "catena/core/sphere.h"

namespace catena::reference {

/// The gap q - t of two spheres, q = |cA - cB|^2 and t = (rA + rB)^2, in binary64, with the scale of its
/// error.
///
/// Error bound, u = 2^-53. Differences and sums of two binary32 numbers are rounded once, and no square of
/// one overflows (< 2^260) or underflows (>= 2^-298 unless 0), so q has relative error <= 5.01u (difference
/// twice, square, two additions of positive terms) and t <= 3.01u. Measured by the computed values, |error of
/// q - t| is thus <= 5.02u(q + t), and <= 6.03u(q + t) after the subtraction is rounded too. 2^-50 = 8u also
/// covers the rounding of q + t itself. This holds with and without fused multiply-add.
struct GapEstimate {
  double gap;      ///< about q - t
  double radii;    ///< about t
  double squares;  ///< about q + t

  static GapEstimate of(double dx, double dy, double dz, double reach) noexcept {
    const double q = dx * dx + dy * dy + dz * dz, t = reach * reach;
    return {q - t, t, q + t};
  }
  static GapEstimate of(const Sphere& a, const Sphere& b) noexcept {
    return of(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z, double{a.radius} + b.radius);
  }
  /// True when `gap` has the sign of the exact gap, which then is not zero.
  bool certain() const noexcept { return std::fabs(gap) > 0x1p-50 * squares; }
};

/// Sign of |cA - cB|^2 - (rA + rB)^2 in exact arithmetic on the stored numbers: -1 the spheres overlap, 0
/// they touch (which counts as overlapping), +1 they are apart. For all finite spheres. O(1), never
/// allocates.
int gap_sign(const Sphere& a, const Sphere& b) noexcept;

/// The same from integers alone, without the binary64 estimate; what the estimate is tested against.
int gap_sign_by_integers(const Sphere& a, const Sphere& b) noexcept;

/// True when the spheres overlap or touch, |cA - cB|^2 <= (rA + rB)^2: the only definition (README, What it is).
inline bool overlap(const Sphere& a, const Sphere& b) noexcept { return gap_sign(a, b) <= 0; }

/// |q - t| / t, rounded once, to nearest: how far a pair is from changing its mind. 0 for touching spheres.
/// Where t = 0 (two points) it is 0 when they coincide and infinite otherwise. O(1), never allocates.
double margin(const Sphere& a, const Sphere& b) noexcept;

}  // namespace catena::reference
