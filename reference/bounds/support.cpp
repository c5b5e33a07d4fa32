#include "catena/reference/bounds/support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/reference/bounds/form.h"

namespace catena::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range everywhere{-infinity, infinity};
// With u = 2^-53. A sum of three or four products, of numbers that may be differences, is computed with an
// error of at most 5.02u of the sum of its terms' absolute values, and three roundings of its sum with others
// and with the error itself follow; a radius times |direction|, all roundings relative, has 5.1u. 16u of all
// terms covers either, and `least` what underflow loses: at most 2^-1075 in each of a dozen operations.
constexpr double slack = 0x1p-49, least = 0x1p-1070;

double dot(const Vector64& a, const Vector64& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Product {
  double value, terms;
  Product(const Vector64& d, const Vector64& p, const Vector64& origin) {
    const double x = d.x * (p.x - origin.x), y = d.y * (p.y - origin.y), z = d.z * (p.z - origin.z);
    value = x + y + z;
    terms = std::fabs(x) + std::fabs(y) + std::fabs(z);
  }
  /// The range of the product plus `more`, whose terms sum up to more_terms; everything when it may overflow.
  Range with(Range more, double more_terms) const {
    const double error = slack * (terms + more_terms) + least;
    if (!(error < 0x1p900)) return everywhere;
    return {value + more.low - error, value + more.high + error};
  }
};

Range both(const Range& a, const Range& b) { return {std::max(a.low, b.low), std::min(a.high, b.high)}; }
double greatest(const Slab& s) { return std::max(std::fabs(s.low), std::fabs(s.high)); }

/// At least |v - (l0 g0 + l1 g1 + l2 g2)| in exact arithmetic.
double residual(double v, double l0, double g0, double l1, double g1, double l2, double g2) {
  const double a = l0 * g0, b = l1 * g1, c = l2 * g2;
  return std::fabs(v - a - b - c) + slack * (std::fabs(v) + std::fabs(a) + std::fabs(b) + std::fabs(c)) +
         least;
}
/// At least the sum of the absolute coordinates of v - (l0 g0 + l1 g1 + l2 g2).
double residual(const Vector64& v, const Vector64& l, std::span<const Slab> s) {
  const Vector64 &p = s[0].direction, &q = s[1].direction, &r = s[2].direction;
  return residual(v.x, l.x, p.x, l.y, q.x, l.z, r.x) + residual(v.y, l.x, p.y, l.y, q.y, l.z, r.y) +
         residual(v.z, l.x, p.z, l.y, q.z, l.z, r.z);
}

}  // namespace

Support::Support(const AnyBound& bound) : bound_(bound) {
  if (const auto* c = std::get_if<Capsule64>(&bound)) {
    edges_[0] = {c->b.x - c->a.x, c->b.y - c->a.y, c->b.z - c->a.z};
    edge_count_ = 1;
  } else if (std::holds_alternative<Box64>(bound)) {
    edges_ = {Vector64{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    edge_count_ = 3;
  } else if (const auto* s = std::get_if<Slabs64>(&bound); s && s->slabs.size() >= 3) {
    measure(*s);
  }
}

/// Edges e with e[i] . g[j] = (i == j), about, for the directions g. Whatever they are, each point p has
/// y[i] = g[i] . (p - origin) within slab i, and v . (p - origin) = sum of (v . e[i]) y[i] + r . (p - origin)
/// with r = v - sum of (v . e[i]) g[i]. For v an axis and m the largest coordinate of p - origin this says
/// that m <= sum |e[i]| max |y[i]| + m / 4 when r's coordinates sum up to at most 1/4. So m is at most 4/3 of
/// that sum, and twice it leaves room for rounding.
void Support::measure(const Slabs64& s) {
  const Vector64 &p = s.slabs[0].direction, &q = s.slabs[1].direction, &r = s.slabs[2].direction;
  const auto cross = [](const Vector64& a, const Vector64& b, double by) {
    return Vector64{(a.y * b.z - a.z * b.y) / by, (a.z * b.x - a.x * b.z) / by, (a.x * b.y - a.y * b.x) / by};
  };
  const double volume = dot(p, cross(q, r, 1));
  edges_ = {cross(q, r, volume), cross(r, p, volume), cross(p, q, volume)};
  const auto& e = edges_;
  const Vector64 x{e[0].x, e[1].x, e[2].x}, y{e[0].y, e[1].y, e[2].y}, z{e[0].z, e[1].z, e[2].z};
  const auto reach = [&](const Vector64& l) {
    return std::fabs(l.x) * greatest(s.slabs[0]) + std::fabs(l.y) * greatest(s.slabs[1]) +
           std::fabs(l.z) * greatest(s.slabs[2]);
  };
  size_ = 2 * std::max({reach(x), reach(y), reach(z)});
  const double worst =
      residual({1, 0, 0}, x, s.slabs) + residual({0, 1, 0}, y, s.slabs) + residual({0, 0, 1}, z, s.slabs);
  if (worst <= 0.25 && size_ < 0x1p400) edge_count_ = 3;  // comparisons with NaN are false
}

Range Support::along(const Vector64& d, const Vector64& origin) const {
  if (const auto* c = std::get_if<Capsule64>(&bound_)) return along(d, origin, *c);
  if (const auto* s = std::get_if<Sphere64>(&bound_)) return along(d, origin, capsule(*s));
  if (const auto* b = std::get_if<Box64>(&bound_)) return along(d, origin, *b);
  if (const auto* s = std::get_if<Slabs64>(&bound_)) return along(d, origin, *s);
  return everywhere;
}

Range Support::along(const Vector64& d, const Vector64& origin, const Capsule64& c) const {
  const double square = dot(d, d);
  if (!(square > 0x1p-900 && square < 0x1p900)) return everywhere;
  const double r = c.radius * std::sqrt(square);
  const Range a = Product(d, c.a, origin).with({-r, r}, r), b = Product(d, c.b, origin).with({-r, r}, r);
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

Range Support::along(const Vector64& d, const Vector64& origin, const Box64& b) const {
  // A coordinate that does not count may be infinite: the origin's then stands for it.
  const auto end = [](double k, double low, double high, double o) {
    return k == 0 ? o : k > 0 ? high : low;
  };
  const auto corner = [&](double s) {
    return Vector64{end(s * d.x, b.low.x, b.high.x, origin.x), end(s * d.y, b.low.y, b.high.y, origin.y),
                    end(s * d.z, b.low.z, b.high.z, origin.z)};
  };
  return {Product(d, corner(-1), origin).with({0, 0}, 0).low,
          Product(d, corner(1), origin).with({0, 0}, 0).high};
}

Range Support::along(const Vector64& d, const Vector64& origin, const Slabs64& s) const {
  const Product offset(d, s.origin, origin);
  Range range = everywhere;
  for (const Slab& slab : s.slabs) {
    if (slab.direction != d) continue;
    // End by end, as one may be infinite.
    if (std::isfinite(slab.low))
      range.low = std::max(range.low, offset.with({slab.low, 0}, std::fabs(slab.low)).low);
    if (std::isfinite(slab.high))
      range.high = std::min(range.high, offset.with({0, slab.high}, std::fabs(slab.high)).high);
  }
  if (edge_count_ == 0) return range;
  const Vector64 l{dot(d, edges_[0]), dot(d, edges_[1]), dot(d, edges_[2])};
  const double rest = residual(d, l, s.slabs) * size_;
  Range sum{-rest, rest};
  double terms = rest;
  const auto add = [&](double factor, const Slab& slab) {
    const double a = factor * slab.low, b = factor * slab.high;
    sum.low += std::min(a, b);
    sum.high += std::max(a, b);
    terms += std::fabs(factor) * greatest(slab);
  };
  add(l.x, s.slabs[0]), add(l.y, s.slabs[1]), add(l.z, s.slabs[2]);
  return both(range, offset.with(sum, terms));
}

}  // namespace catena::reference
