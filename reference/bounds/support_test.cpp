#include "catena/reference/bounds/support.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

#include "catena/reference/testing/bodies.h"

/// What binary64 is certain of, against rationals: all of a bound lies between the ends, by whatever they are
/// rounded.
namespace catena::reference {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Point = std::array<Rational, 3>;

using testing::dot;
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point point(const Vector64& v) { return {Rational(v.x), Rational(v.y), Rational(v.z)}; }
Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// A whole number of up to so many bits, each number of bits as often.
double whole(int bits) {
  const double most = std::ldexp(1.0, *rc::gen::resize(100, rc::gen::inRange(0, bits + 1)));
  return std::round(most * *rc::gen::resize(100, rc::gen::inRange(-1000000, 1000001)) / 1000000.0);
}
Vector64 vector(int bits) { return {whole(bits), whole(bits), whole(bits)}; }

RC_GTEST_PROP(BoundsSupport, OfSlabsHoldsTheirCorners, ()) {
  // The third direction lies nearly in a plane with the others, as nearly as may be.
  std::vector<Slab> slabs;
  for (int k = 0; k < 3; ++k) slabs.push_back({vector(50), -std::fabs(whole(50)), std::fabs(whole(50))});
  const Vector64 &d = slabs[0].direction, &e = slabs[1].direction, aside = vector(30);
  slabs[2].direction = {d.x + e.x + aside.x, d.y + e.y + aside.y, d.z + e.z + aside.z};
  const std::array g{point(d), point(e), point(slabs[2].direction)};
  const Point normal[]{cross(g[1], g[2]), cross(g[2], g[0]), cross(g[0], g[1])};
  const Rational volume = dot(g[0], normal[0]);
  RC_PRE(volume != 0);
  const Vector64 from = vector(20), along = vector(20);
  const Slabs64 bound{vector(20), slabs};
  const Range range = Support(AnyBound(bound)).along(along, from);
  RC_TAG(std::isfinite(range.low) ? "known" : "unknown");
  const Rational offset = dot(point(along), point(bound.origin) - point(from));
  for (int corner = 0; corner < 8; ++corner) {
    Rational at = 0;
    for (int k = 0; k < 3; ++k)
      at += Rational(corner >> k & 1 ? slabs[k].high : slabs[k].low) * dot(point(along), normal[k]);
    at = at / volume + offset;
    if (std::isfinite(range.low)) RC_ASSERT(Rational(range.low) <= at);
    if (std::isfinite(range.high)) RC_ASSERT(at <= Rational(range.high));
  }
}

RC_GTEST_PROP(BoundsSupport, OfBallsAndCapsulesHoldsThem, ()) {
  const double scale = std::ldexp(1.0, *rc::gen::element(-600, -300, 0, 300, 600));
  const Vector64 way = vector(20), along{way.x * scale, way.y * scale, way.z * scale}, from = vector(20);
  const Capsule64 capsule{vector(20), vector(20), std::fabs(whole(50))};
  const Range range = Support(AnyBound(capsule)).along(along, from);
  const Rational reach =
      Rational(capsule.radius) * Rational(capsule.radius) * dot(point(along), point(along));
  for (const Vector64& end : {capsule.a, capsule.b}) {
    const Rational at = dot(point(along), point(end) - point(from));
    for (const auto& [bound, side] : {std::pair(range.low, -1), {range.high, 1}}) {
      if (!std::isfinite(bound)) continue;
      const Rational room = side * (Rational(bound) - at);
      RC_ASSERT(room >= 0);
      RC_ASSERT(room * room >= reach);
    }
  }
}

}  // namespace
}  // namespace catena::reference
