#include "catena/reference/bounds/segments.h"

#include <algorithm>
#include <cmath>

#include "catena/reference/bounds/exact.h"

namespace catena::reference {
namespace {

using exact::Integer, exact::Vector;

struct Segment {
  Vector from, to;
};

/// Sign of numerator / denominator - reach^2, denominator > 0.
int compare(const Integer& numerator, const Integer& denominator, const Integer& reach) {
  return numerator.compare(reach * reach * denominator);
}
int sign(int comparison) { return comparison < 0 ? -1 : comparison > 0 ? 1 : 0; }

int compare_distance(const Vector& p, const Segment& s, const Integer& reach) {
  const Vector along = s.to - s.from, w = p - s.from;
  const Integer t = dot(w, along), q = square(along);
  if (t <= 0 || q.is_zero()) return compare(square(w), 1, reach);
  if (t >= q) return compare(square(p - s.to), 1, reach);
  return compare(square(w) * q - t * t, q, reach);
}

int compare_distance(const Segment& a, const Segment& b, const Integer& reach) {
  const Vector u = a.to - a.from, v = b.to - b.from, w = a.from - b.from;
  const Integer uu = square(u), uv = dot(u, v), vv = square(v), uw = dot(u, w), vw = dot(v, w);
  const Integer area = uu * vv - uv * uv;
  if (area > 0) {  // not parallel: the lines are nearest at a.from + s/area u and b.from + t/area v
    const Integer s = uv * vw - vv * uw, t = uu * vw - uv * uw;
    if (s >= 0 && s <= area && t >= 0 && t <= area) {
      const Integer height = dot(w, cross(u, v));
      return sign(compare(height * height, area, reach));
    }
  }
  // Else an end of one is nearest: the square of the distance is convex, and without a least point inside.
  return sign(std::min({compare_distance(a.from, b, reach), compare_distance(a.to, b, reach),
                        compare_distance(b.from, a, reach), compare_distance(b.to, a, reach)}));
}

double dot(const Vector64& a, const Vector64& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector64 operator-(const Vector64& a, const Vector64& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double sum(const Vector64& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }
double clamp(double t) { return t > 0 ? std::min(t, 1.0) : 0; }  // of NaN: 0

/// About where on each segment, from 0 to 1, they are nearest. Nothing depends on how good the guess is.
struct Nearest {
  double s, t;
  Nearest(const Vector64& u, const Vector64& v, const Vector64& w) {
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    s = clamp((uv * vw - vv * uw) / (uu * vv - uv * uv));
    t = clamp((uv * s + vw) / vv);
    s = clamp((uv * t - uw) / uu);
  }
};

/// The sign that binary64 is certain of, else 0. With u = 2^-53 and the sum m of the absolute values of all
/// coordinates of the differences a.to - a.from, b.to - b.from and a.from - b.from, each exact to u:
/// - The points at s and t are on the segments exactly, so the distance is at most theirs. Their difference d
/// is
///   computed with two products, two sums: each coordinate's error is at most 4.02u of the sum of the
///   absolute values of its terms, together at most 4.03u m, and the length is computed to 3u of itself.
/// - All points of a are on one side of those of b along d, whatever d is, if the least of (p - q) . d is >
/// 0, and the
///   distance is at least that over |d|. It is computed from three products with an error of at most 4.02u of
///   their terms and two sums, together 6.1u |d| m.
/// In both, 2^-49 m = 16u m leaves room for the rounding of the few operations that follow, and for what
/// underflow loses while m > 2^-400 and |d| is > 2^-400 or not divided by: below 2^-530 in a length, 2^-1070
/// in a product. The numbers of a scene are in that range, and infinities are not.
int estimate(const Segment64& a, const Segment64& b, double x, double y) {
  const Vector64 u = a.to - a.from, v = b.to - b.from, w = a.from - b.from;
  const double m = sum(u) + sum(v) + sum(w), reach = x + y;
  if (!(m > 0x1p-400 && m < 0x1p400)) return 0;
  constexpr double slack = 0x1p-49;
  const Nearest at(u, v, w);
  const Vector64 d{w.x + at.s * u.x - at.t * v.x, w.y + at.s * u.y - at.t * v.y,
                   w.z + at.s * u.z - at.t * v.z};
  const double length = std::sqrt(dot(d, d));
  if (length + slack * m < reach * (1 - slack)) return -1;
  const double apart = dot(w, d) + std::min(0.0, dot(u, d)) - std::max(0.0, dot(v, d));
  if (length > 0x1p-400 && apart - slack * length * m > length * reach * (1 + slack)) return 1;
  return 0;
}

}  // namespace

int compare_distance_by_integers(const Segment64& a, const Segment64& b, double x, double y) {
  exact::Unit unit;
  for (const Vector64& p : {a.from, a.to, b.from, b.to}) unit.fit(p);
  unit.fit(x), unit.fit(y);
  return compare_distance(Segment{unit(a.from), unit(a.to)}, Segment{unit(b.from), unit(b.to)},
                          Integer(unit(x) + unit(y)));
}

int compare_distance(const Segment64& a, const Segment64& b, double x, double y) {
  if (const int certain = estimate(a, b, x, y); certain != 0) return certain;
  return compare_distance_by_integers(a, b, x, y);
}

}  // namespace catena::reference
