#include "catena/core/readers/point_rounding.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "catena/core/readers/reader.h"

namespace catena {
namespace {

struct Point {
  std::array<double, 3> at;
  float radius;
};

// By the definition: of every point that is kept and along every axis what is lost, whichever point and axis
// comes last, and whether its radius is told with it or after all points.
RC_GTEST_PROP(PointRounding, KeepsTheGreatestErrorOfAnyCoordinate, (bool recentre, bool open)) {
  std::vector<Point> points(*rc::gen::inRange<std::size_t>(1, 6));
  for (Point& point : points) {
    for (double& x : point.at)
      x = *rc::gen::inRange(-1000, 1000) / 7.0 * *rc::gen::element(1.0, 1.0, 1e3, 1e9);
    point.radius = *rc::gen::element(0.0f, 0.25f, 1.0f, 8.0f);
  }
  ReadOptions options;
  options.recentre = recentre;
  CurveFile curves(options);
  double error = 0, share = 0;
  std::vector<Sphere> kept;
  std::vector<std::size_t> kept_point;
  for (const Point& point : points) {
    if (open)
      curves.add_open_point(point.at[0], point.at[1], point.at[2]),
          curves.spheres.back().radius = point.radius;
    else
      curves.add_point(point.at[0], point.at[1], point.at[2], point.radius);
    const Sphere rounded = curves.spheres.back();
    if (open && !*rc::gen::arbitrary<bool>()) continue;
    kept.push_back(rounded), kept_point.push_back(curves.spheres.size() - 1);
    const std::array<float, 3> got{rounded.x, rounded.y, rounded.z};
    double most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = point.at[axis] - (recentre ? points[0].at[axis] : 0);
      RC_ASSERT(got[axis] == static_cast<float>(x));
      most = std::max(most, std::abs(x - got[axis]));
    }
    RC_ASSERT(rounded.radius == point.radius);
    error = std::max(error, most);
    if (point.radius > 0) share = std::max(share, most / point.radius);
  }
  if (open) curves.rounding.settle(kept, [&](std::size_t k) { return kept_point[k]; });
  RC_ASSERT(curves.rounding.greatest_error() == error);
  RC_ASSERT(curves.rounding.greatest_share() == share);
  RC_ASSERT(curves.rounding.origin().has_value() == recentre);
}

}  // namespace
}  // namespace catena
