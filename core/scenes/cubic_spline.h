#pragma once
#include <cstddef>
#include <vector>

#include "catena/core/vec3.h"

namespace catena {

/// The natural cubic spline through control points: twice continuously differentiable, straight at both ends.
/// The parameter of a control point is the length of the polygon up to it, so that the speed stays near 1.
/// Source: de Boor, A Practical Guide to Splines, chapter IV; the tridiagonal system by Thomas's algorithm.
class CubicSpline {
 public:
  /// At least two points, successive ones different. O(number of points).
  explicit CubicSpline(std::vector<Vec3> points);

  double end() const { return knots_.back(); }  ///< the parameter runs from 0 to end()
  double knot(std::size_t point) const { return knots_[point]; }
  std::size_t points() const { return knots_.size(); }

  /// Length of the curve from the control point `first` to `last` >= first, to about 1e-10 of it.
  double arc_length(std::size_t first, std::size_t last) const;

  /// Where a walk along the spline is; walking on from a near parameter costs O(1).
  struct Cursor {
    std::size_t segment = 0;
  };
  Vec3 position(double t, Cursor& cursor) const;
  Vec3 derivative(double t, Cursor& cursor) const;

 private:
  struct Segment {
    Vec3 c0, c1, c2, c3;  // position at knot + u: c0 + c1 u + c2 u^2 + c3 u^3
  };
  void seek(double t, Cursor& cursor) const;

  std::vector<double> knots_;
  std::vector<Segment> segments_;
};

}  // namespace catena
