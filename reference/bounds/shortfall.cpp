#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/reference/bounds.h"
#include "catena/reference/bounds/form.h"
#include "catena/reference/enclosure.h"

namespace catena::reference {
namespace {

using Real = long double;  // wider exponents: squares of binary64 neither overflow nor underflow
constexpr double infinity = std::numeric_limits<double>::infinity();

/// How far the sphere sticks out, and the size of the bound.
struct Out {
  Real by, size;
};

struct Measure {
  const Sphere64& s;

  Out operator()(const Everything&) const { return {-1, 1}; }
  Out operator()(const Sphere64& b) const { return {Real(reference::shortfall(b, s)), 1}; }
  Out operator()(const Capsule64& c) const {
    const Real ux = Real(c.b.x) - c.a.x, uy = Real(c.b.y) - c.a.y, uz = Real(c.b.z) - c.a.z;
    const Real wx = Real(s.x) - c.a.x, wy = Real(s.y) - c.a.y, wz = Real(s.z) - c.a.z;
    const Real square = ux * ux + uy * uy + uz * uz;
    const Real t = square > 0 ? std::clamp<Real>((ux * wx + uy * wy + uz * wz) / square, 0, 1) : 0;
    const Real distance = std::hypot(wx - t * ux, wy - t * uy, wz - t * uz);
    return {distance - (Real(c.radius) - s.radius), std::max<Real>(c.radius, std::sqrt(square) / 2)};
  }
  Out operator()(const Box64& b) const {
    Out out{-std::numeric_limits<Real>::infinity(), 0};
    add(out, b.low.x, s.x, b.high.x, s.radius, 1);
    add(out, b.low.y, s.y, b.high.y, s.radius, 1);
    add(out, b.low.z, s.z, b.high.z, s.radius, 1);
    return out;
  }
  Out operator()(const Slabs64& b) const {
    Out out{-std::numeric_limits<Real>::infinity(), 0};
    for (const Slab& slab : b.slabs) {
      const Vector64& d = slab.direction;
      const Real length = std::hypot(Real(d.x), Real(d.y), Real(d.z));
      const Real at =
          d.x * (Real(s.x) - b.origin.x) + d.y * (Real(s.y) - b.origin.y) + d.z * (Real(s.z) - b.origin.z);
      add(out, slab.low, at, slab.high, s.radius * length, length);
    }
    return out;
  }
  /// Along one direction of that length, whose ends, place and radius are in it.
  static void add(Out& out, Real low, Real at, Real high, Real radius, Real length) {
    out.by = std::max({out.by, (low - (at - radius)) / length, (at + radius - high) / length});
    if (std::isfinite(high - low)) out.size = std::max(out.size, (high - low) / 2 / length);
  }
};

}  // namespace

double shortfall(const AnyBound& bound, const Sphere64& sphere) {
  const bool in = contains(bound, sphere);
  if (!proper(bound) || !proper(sphere) || (is_everything(sphere) && !in)) return infinity;
  if (is_everything(bound)) return -1;
  const Out out = std::visit(Measure{sphere}, bound);
  // Rounding may contradict the exact test, which is right, only where the result is next to nothing.
  if (in) return out.by < 0 && out.size > 0 ? static_cast<double>(std::min<Real>(0, out.by / out.size)) : 0;
  if (out.size == 0) return infinity;
  return std::max(static_cast<double>(out.by / out.size), std::numeric_limits<double>::denorm_min());
}

}  // namespace catena::reference
