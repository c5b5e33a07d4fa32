#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "catena/core/vec3.h"

namespace catena::bench {

/// A smooth curve on [0, 1], travelled at unit speed: parameters at equal steps of arc length, found once by
/// Gauss-Legendre quadrature, between which Newton's method finds any other.
class ArcLength {
 public:
  using Curve = std::function<Vec3(double)>;
  /// `derivative` never vanishes; `pieces` so many that it is near a polynomial of degree 9 on each.
  /// O(pieces).
  ArcLength(const Curve& derivative, std::size_t pieces);

  double total() const { return at_.back(); }  ///< length of the whole curve
  /// The curve parameter at arc length s, 0 <= s <= length(), to about 1e-14. O(log pieces).
  double parameter(double s) const;

 private:
  double between(double from, double to) const;  ///< arc length, by five Gauss points

  Curve derivative_;
  std::vector<double> at_;  // arc length at the ends of the pieces
};

}  // namespace catena::bench
