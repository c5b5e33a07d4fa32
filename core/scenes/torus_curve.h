#pragma once
#include <cstdint>
#include <functional>

#include "catena/core/vec3.h"

namespace catena {

/// The closed curve that winds p times around the axis of a torus (radius 1) and q times around its core
/// (radius 0.4). A knot when p and q are coprime. The parameter t runs from 0 to 1 once around the curve.
struct TorusCurve {
  std::uint32_t p, q;

  static constexpr double core = 1, around = 0.4;  ///< radii of the torus

  Vec3 position(double t) const;
  double speed(double t) const;  ///< |d position / dt|
  double arc_length() const;     ///< of the whole curve, to 1e-12 of it
  /// Parameters from 0 on, at equal arc lengths, n of them in the whole curve: the next at each call. Cost
  /// O(1 + (p + q)/n) each.
  std::function<double()> equal_steps(std::uint32_t n) const;
  /// The least distance of two neighbouring windings, to about 1e-12: half of it is the greatest radius of a
  /// tube that does not cut itself there. For coprime p >= 2 and q. O(1).
  double closest_windings() const;
};

}  // namespace catena
