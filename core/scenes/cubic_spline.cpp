#include "catena/core/scenes/cubic_spline.h"

namespace catena {

CubicSpline::CubicSpline(std::vector<Vec3> points) {
  const std::size_t last = points.size() - 1;
  knots_.push_back(0);
  for (std::size_t i = 0; i < last; ++i) knots_.push_back(knots_[i] + length(points[i + 1] - points[i]));

  // Second derivatives at the inner knots; those at the two ends stay zero. Forward elimination, then back.
  std::vector<Vec3> second(last + 1);
  std::vector<double> upper(last + 1, 0);
  for (std::size_t i = 1; i < last; ++i) {
    const double before = knots_[i] - knots_[i - 1], after = knots_[i + 1] - knots_[i];
    const Vec3 bend =
        6 * (1 / after * (points[i + 1] - points[i]) - 1 / before * (points[i] - points[i - 1]));
    const double pivot = 2 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    second[i] = 1 / pivot * (bend - before * second[i - 1]);
  }
  for (std::size_t i = last; i-- > 1;) second[i] = second[i] - upper[i] * second[i + 1];

  for (std::size_t i = 0; i < last; ++i) {
    const double step = knots_[i + 1] - knots_[i];
    segments_.push_back(
        {points[i], 1 / step * (points[i + 1] - points[i]) - step / 6 * (2.0 * second[i] + second[i + 1]),
         0.5 * second[i], 1 / (6 * step) * (second[i + 1] - second[i])});
  }
}

double CubicSpline::arc_length(std::size_t first, std::size_t last) const {
  constexpr int pieces = 64;  // Simpson's rule with 64 pieces a segment
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) {
    Cursor cursor{i};
    const double step = (knots_[i + 1] - knots_[i]) / pieces;
    for (int k = 0; k <= pieces; ++k) {
      const double weight = k == 0 || k == pieces ? 1 : k % 2 == 1 ? 4 : 2;
      sum += weight * step / 3 * length(derivative(knots_[i] + k * step, cursor));
    }
  }
  return sum;
}

Vec3 CubicSpline::position(double t, Cursor& cursor) const {
  seek(t, cursor);
  const Segment& s = segments_[cursor.segment];
  const double u = t - knots_[cursor.segment];
  return s.c0 + u * (s.c1 + u * (s.c2 + u * s.c3));
}

Vec3 CubicSpline::derivative(double t, Cursor& cursor) const {
  seek(t, cursor);
  const Segment& s = segments_[cursor.segment];
  const double u = t - knots_[cursor.segment];
  return s.c1 + u * (2.0 * s.c2 + 3 * u * s.c3);
}

void CubicSpline::seek(double t, Cursor& cursor) const {
  while (cursor.segment > 0 && t < knots_[cursor.segment]) --cursor.segment;
  while (cursor.segment + 1 < segments_.size() && t >= knots_[cursor.segment + 1]) ++cursor.segment;
}

}  // namespace catena
