#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "catena/reference/bounds.h"
#include "catena/reference/bounds/segments.h"
#include "catena/reference/testing/bodies.h"
#include "catena/reference/testing/nasty.h"

/// Whether estimates in binary64 say what the integers say, of numbers without any pattern.
namespace catena::reference {
namespace {

using testing::infinity;
using testing::Kind;

/// A bound of that kind of numbers that `number` draws; the slabs are kept in `slabs`.
template <class Number>
AnyBound drawn(Kind kind, Number number, std::vector<Slab>& slabs) {
  const auto vector = [&] { return Vector64{number(), number(), number()}; };
  const Vector64 p = vector(), q = vector();
  if (kind == Kind::sphere) return Sphere64{p.x, p.y, p.z, std::fabs(number())};
  if (kind == Kind::capsule) return Capsule64{p, q, std::fabs(number())};
  if (kind == Kind::box)
    return Box64{{std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)},
                 {std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)}};
  const int count = *rc::gen::inRange(1, 6);
  for (int k = 0; k < count; ++k) {
    Vector64 d = vector();
    if (k == 2 && *rc::gen::arbitrary<bool>()) {  // nearly in a plane with those before
      const Vector64 &e = slabs[0].direction, &f = slabs[1].direction;
      d = {e.x + f.x, e.y + f.y, std::nextafter(e.z + f.z, 0)};
    }
    if (!std::isfinite(d.x + d.y + d.z) || d == Vector64{0, 0, 0}) d = {1, 0, 0};
    const auto end = [&] { return std::fmax(0, std::fabs(number()) * std::hypot(d.x, d.y, d.z)); };
    slabs.push_back({d, -end(), end()});
  }
  return Slabs64{p, slabs};
}

void expect_agreement(const AnyBound& a, const AnyBound& b) {
  const bool by_integers = separate_by_integers(a, b);
  RC_ASSERT(separate_by_integers(b, a) == by_integers);
  RC_ASSERT(separate(a, b) == by_integers);
  RC_ASSERT(separate(b, a) == by_integers);
}

AnyBound moved(const AnyBound& bound, double x) {
  struct Move {
    double x;
    void operator()(Everything&) const {}
    void operator()(Sphere64& s) const { s.x += x; }
    void operator()(Capsule64& c) const { c.a.x += x, c.b.x += x; }
    void operator()(Box64& b) const { b.low.x += x, b.high.x += x; }
    void operator()(Slabs64& s) const { s.origin.x += x; }
  };
  AnyBound result = bound;
  std::visit(Move{x}, result);
  return result;
}

RC_GTEST_PROP(BoundsEstimates, AgreeWithIntegersNearTies, ()) {
  // Two bounds are moved apart until the integers change their mind, to the last bit of the way.
  const int exponent = *rc::gen::inRange(-140, 100);
  const auto number = [&] { return std::ldexp(*rc::gen::inRange(-1000000, 1000001) / 997.0, exponent); };
  std::vector<Slab> p, q;
  const AnyBound a = drawn(testing::any_kind(), number, p), b = drawn(testing::any_kind(), number, q);
  double near = 0, far = std::ldexp(1.0, exponent + 16);
  expect_agreement(a, b);
  if (separate_by_integers(a, b) || !separate_by_integers(a, moved(b, far))) return;
  for (int k = 0; k < 70; ++k) {
    const double middle = near + (far - near) / 2;
    (separate_by_integers(a, moved(b, middle)) ? far : near) = middle;
    if (k % 8 == 0) expect_agreement(a, moved(b, middle));
  }
  for (int k = 0; k < 4; ++k) {
    expect_agreement(a, moved(b, near));
    expect_agreement(a, moved(b, far));
    near = std::nextafter(near, -infinity), far = std::nextafter(far, infinity);
  }
  RC_TAG("tie of kinds", a.index(), b.index());
}

RC_GTEST_PROP(BoundsEstimates, AgreeWithIntegersAtCornersOfBoxes, ()) {
  // A point of a sphere's distance, rounded, from a corner.
  const auto number = [] { return *rc::gen::inRange(1, 1000001) / 997.0; };
  for (int k = 0; k < 5; ++k) {
    const Box64 box{{-1, -1, -1}, {number(), number(), number()}};
    const double x = number(), y = number(), z = number();
    const Sphere64 s{box.high.x + x, box.high.y + y, box.high.z + z, std::sqrt(x * x + y * y + z * z)};
    for (const double r : {std::nextafter(s.radius, 0), s.radius, std::nextafter(s.radius, infinity)})
      expect_agreement(box, Sphere64{s.x, s.y, s.z, r});
  }
}

RC_GTEST_PROP(BoundsEstimates, AgreeWithIntegersOnNeedles, ()) {
  // Long and thin ones that all but meet, at a distance that their lengths' rounding moves.
  const auto number = [] { return *rc::gen::inRange(-1000000, 1000001) / 997.0; };
  const auto vector = [&] { return Vector64{number(), number(), number()}; };
  const Vector64 p = vector(), u = vector(), v = vector();
  const double s = *rc::gen::inRange(0, 1001) / 1000.0, t = *rc::gen::inRange(0, 1001) / 1000.0;
  const Vector64 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const double small = 0x1p-40, distance = small * std::hypot(n.x, n.y, n.z);
  const Vector64 q{p.x + s * u.x - t * v.x + small * n.x, p.y + s * u.y - t * v.y + small * n.y,
                   p.z + s * u.z - t * v.z + small * n.z};
  const Segment64 a{p, {p.x + u.x, p.y + u.y, p.z + u.z}}, b{q, {q.x + v.x, q.y + v.y, q.z + v.z}};
  const double step = 0x1p-54 * (std::fabs(p.x) + std::hypot(u.x, u.y, u.z) + std::hypot(v.x, v.y, v.z));
  for (int k = -8; k <= 8; ++k) {
    const double reach = std::fabs(distance + k * step);
    RC_ASSERT(compare_distance(a, b, reach, 0) == compare_distance_by_integers(a, b, reach, 0));
  }
}

RC_GTEST_PROP(BoundsEstimates, AgreeWithIntegersOnAnyNumbers, ()) {
  std::vector<Slab> p, q;
  const bool narrow = *rc::gen::arbitrary<bool>();
  const auto number = [&] { return narrow ? double{*testing::any_float()} : *testing::any_double(); };
  expect_agreement(drawn(testing::any_kind(), number, p), drawn(testing::any_kind(), number, q));
}

}  // namespace
}  // namespace catena::reference
