#include <cmath>

#include "catena/reference/bounds.h"
#include "catena/reference/bounds/form.h"
#include "catena/reference/bounds/halfspaces.h"
#include "catena/reference/bounds/segments.h"
#include "catena/reference/bounds/support.h"
#include "catena/reference/enclosure.h"

namespace catena::reference {
namespace {

/// Capsules and slabs that are not everything, and finite spheres, all proper.
bool in_capsule_by_integers(const Capsule64& c, const Sphere64& s) {
  return c.radius >= s.radius &&
         compare_distance_by_integers({c.a, c.b}, {centre(s), centre(s)}, c.radius, -s.radius) <= 0;
}
bool in_capsule(const Capsule64& c, const Sphere64& s) {
  return c.radius >= s.radius &&
         compare_distance({c.a, c.b}, {centre(s), centre(s)}, c.radius, -s.radius) <= 0;
}

template <class Flat>
bool in_halfspaces(const Flat& bound, const Sphere64& s) {
  exact::Unit unit;
  fit(unit, bound);
  unit.fit(centre(s)), unit.fit(s.radius);
  return contain(halfspaces(bound, unit), unit(centre(s)), unit(s.radius));
}

/// v <= c - r exactly. A rounded difference that is not v is on the right side of it; else its error, which
/// is a number of binary64 (Knuth's two_sum), decides.
bool at_most_difference(double v, double c, double r) {
  const double d = c - r;
  if (v != d) return v < d;
  if (std::isinf(d))
    return v < 0;  // a finite difference that overflowed is below infinity and above -infinity
  const double c_part = d + r, r_part = c_part - d;
  return (c - c_part) - (r - r_part) >= 0;
}

bool in_box(const Box64& b, const Sphere64& s) {
  const auto in = [&](double low, double c, double high) {
    return at_most_difference(low, c, s.radius) && at_most_difference(-high, -c, s.radius);
  };
  return in(b.low.x, s.x, b.high.x) && in(b.low.y, s.y, b.high.y) && in(b.low.z, s.z, b.high.z);
}

bool in_slabs(const Slabs64& slabs, const Sphere64& s) {
  const Support ball{AnyBound(s)};
  for (const Slab& slab : slabs.slabs) {
    const Range range = ball.along(slab.direction, slabs.origin);
    if (slab.low <= range.low && range.high <= slab.high) continue;
    if (!in_halfspaces(Slabs64{slabs.origin, {&slab, 1}}, s)) return false;
  }
  return true;
}

/// What needs no arithmetic: a bound or sphere that is not proper, everything, a sphere that is not finite.
enum class Case { no, yes, finite };
Case easy(const AnyBound& bound, const Sphere64& s) {
  if (!proper(bound) || !proper(s)) return Case::no;
  if (is_everything(bound)) return Case::yes;
  return is_everything(s) ? Case::no : Case::finite;
}

struct Contains {
  const Sphere64& s;
  bool operator()(const Everything&) const { return true; }
  bool operator()(const Sphere64& b) const { return encloses(b, s); }
  bool operator()(const Capsule64& b) const { return in_capsule(b, s); }
  bool operator()(const Box64& b) const { return in_box(b, s); }
  bool operator()(const Slabs64& b) const { return in_slabs(b, s); }
};

struct ContainsByIntegers {
  const Sphere64& s;
  bool operator()(const Everything&) const { return true; }
  bool operator()(const Sphere64& b) const { return encloses_by_integers(b, s); }
  bool operator()(const Capsule64& b) const { return in_capsule_by_integers(b, s); }
  bool operator()(const Box64& b) const { return in_halfspaces(b, s); }
  bool operator()(const Slabs64& b) const { return in_halfspaces(b, s); }
};

}  // namespace

bool contains(const AnyBound& bound, const Sphere64& sphere) {
  if (const Case c = easy(bound, sphere); c != Case::finite) return c == Case::yes;
  return std::visit(Contains{sphere}, bound);
}

bool contains_by_integers(const AnyBound& bound, const Sphere64& sphere) {
  if (const Case c = easy(bound, sphere); c != Case::finite) return c == Case::yes;
  return std::visit(ContainsByIntegers{sphere}, bound);
}

}  // namespace catena::reference
