#include "catena/core/motion/knot.h"

#include "catena/core/scenes/cubic_spline.h"
#include "catena/core/scenes/torus_curve.h"

namespace catena::motion {
namespace {

/// A torus knot (2, 3), cut where it is farthest out and runs along x. Its two ends pass there one above the
/// other and go on straight.
CubicSpline overhand_curve(double tail) {
  constexpr double loop = 60, cut = 0.05;  // length in radii; share of the loop that is cut off at each end
  constexpr int pieces = 60;
  const TorusCurve trefoil{2, 3};
  const double scale = loop / trefoil.arc_length();
  const auto knot = [&](double t) {
    const Vec3 p = scale * trefoil.position(t);
    return Vec3{p.y, p.x, p.z};
  };
  const Vec3 begin = knot(cut), end = knot(1 - cut);
  const double out = knot(0).y;
  std::vector<Vec3> control;
  const auto steps = static_cast<int>(tail / 2) + 2;
  for (int k = steps; k >= 2; --k) control.push_back({begin.x - 2 * k, out, begin.z});
  for (int k = 0; k <= pieces; ++k) control.push_back(knot(cut + (1 - 2 * cut) * k / pieces));
  for (int k = 2; k <= steps; ++k) control.push_back({end.x + 2 * k, out, end.z});
  return CubicSpline(std::move(control));
}

/// Bisects a function that is negative at `low` and positive at `high` down to neighbouring numbers.
template <class F>
double root(double low, double high, const F& f) {
  for (int k = 0; k < 64; ++k) {
    const double middle = (low + high) / 2;
    (f(middle) < 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace

std::vector<Vec3> overhand_knot(std::uint32_t n, double spacing) {
  const double length_asked = spacing * n;
  const CubicSpline spline = overhand_curve(length_asked / 2);
  // The curve mirrors itself (y stays, x and z change sign), and its speed is near 1.
  const double middle = spline.end() / 2;
  CubicSpline::Cursor cursor;
  std::vector<Vec3> points;
  points.reserve(n);
  double t = middle - length_asked / 2;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (i > 0)
      t = root(t, t + 1.5 * spacing,
               [&](double at) { return length(spline.position(at, cursor) - points.back()) - spacing; });
    points.push_back(spline.position(t, cursor));
  }
  return points;
}

void add_knotted_rope(RopeMotion::Start& start, std::uint32_t n, double spacing, const Vec3& root,
                      Random& random) {
  constexpr double speed = 0.05;
  for (const Vec3& p : overhand_knot(n, spacing)) {
    start.position.push_back(root + p);
    start.velocity.push_back(speed * random.cube());
  }
  if (start.first.empty()) start.first.push_back(0);
  start.first.push_back(static_cast<std::uint32_t>(start.position.size()));
}

}  // namespace catena::motion
