#include "catena/reference/bounds/along.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/reference/bounds/form.h"

namespace catena::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// With u = 2^-53. A product direction . (p - origin) is computed with an error of at most 4.02u of the sum
// `terms` of its terms' absolute values, and three roundings of its sum with others and with the error itself
// follow; a radius times |direction|, all roundings relative, has 5.1u. 16u of all terms covers either, and
// `least` what underflow loses: at most 2^-1075 in each of a dozen operations.
constexpr double slack = 0x1p-49, least = 0x1p-1070;

struct Product {
  double value, terms;
  Product(const Vector64& d, const Vector64& p, const Vector64& origin) {
    const double x = d.x * (p.x - origin.x), y = d.y * (p.y - origin.y), z = d.z * (p.z - origin.z);
    value = x + y + z;
    terms = std::fabs(x) + std::fabs(y) + std::fabs(z);
  }
  /// The range of the product plus `more`, whose terms sum up to more_terms; everything when it may overflow.
  Range with(double low, double high, double more_terms) const {
    const double error = slack * (terms + more_terms) + least;
    if (!(error < 0x1p900)) return {-infinity, infinity};
    return {value + low - error, value + high + error};
  }
};

struct Along {
  const Vector64& d;
  const Vector64& origin;

  Range operator()(const Everything&) const { return {-infinity, infinity}; }
  Range operator()(const Sphere64& s) const { return (*this)(capsule(s)); }
  Range operator()(const Capsule64& c) const {
    const double square = d.x * d.x + d.y * d.y + d.z * d.z;
    if (!(square > 0x1p-900 && square < 0x1p900)) return {-infinity, infinity};
    const double r = c.radius * std::sqrt(square);
    const Range a = Product(d, c.a, origin).with(-r, r, r), b = Product(d, c.b, origin).with(-r, r, r);
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
  }
  Range operator()(const Box64& b) const {
    const auto pick = [](double k, double low, double high) { return k > 0 ? high : low; };
    const auto corner = [&](double s) {
      // A coordinate that does not count may be infinite: the origin's then counts for nothing.
      const auto one = [&](double k, double low, double high, double o) {
        return k == 0 ? o : pick(k, low, high);
      };
      return Vector64{one(s * d.x, b.low.x, b.high.x, origin.x), one(s * d.y, b.low.y, b.high.y, origin.y),
                      one(s * d.z, b.low.z, b.high.z, origin.z)};
    };
    return {Product(d, corner(-1), origin).with(0, 0, 0).low,
            Product(d, corner(1), origin).with(0, 0, 0).high};
  }
  Range operator()(const Slabs64& s) const {
    Range range{-infinity, infinity};
    for (const Slab& slab : s.slabs) {
      if (slab.direction != d) continue;
      const Product offset(d, s.origin, origin);
      // By end, as one may be infinite.
      if (std::isfinite(slab.low))
        range.low = std::max(range.low, offset.with(slab.low, slab.low, std::fabs(slab.low)).low);
      if (std::isfinite(slab.high))
        range.high = std::min(range.high, offset.with(slab.high, slab.high, std::fabs(slab.high)).high);
    }
    return range;
  }
};

}  // namespace

Range along(const Vector64& direction, const Vector64& origin, const AnyBound& bound) {
  return std::visit(Along{direction, origin}, bound);
}

}  // namespace catena::reference
