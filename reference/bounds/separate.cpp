#include <algorithm>
#include <cmath>
#include <iterator>

#include "catena/reference/bounds.h"
#include "catena/reference/bounds/form.h"
#include "catena/reference/bounds/halfspaces.h"
#include "catena/reference/bounds/segments.h"
#include "catena/reference/bounds/support.h"
#include "catena/reference/enclosure.h"

// Spheres are capsules, and boxes are slabs, so three questions remain. Two capsules: the distance of two
// segments. Two boxes or slabs: whether half-spaces have a point in common. One of each: the distance of a
// point from half-spaces that were swept back along the segment.
namespace catena::reference {
namespace {

template <class Bound>
constexpr bool is_round = std::is_same_v<Bound, Sphere64> || std::is_same_v<Bound, Capsule64>;

const Capsule64& as_capsule(const Capsule64& c) { return c; }
Capsule64 as_capsule(const Sphere64& s) { return capsule(s); }

template <class Flat>
bool apart(const Flat& flat, const Capsule64& c) {
  exact::Unit unit;
  fit(unit, flat);
  unit.fit(c.a), unit.fit(c.b), unit.fit(c.radius);
  const exact::Vector a = unit(c.a);
  exact::HalfSpaces all = halfspaces(flat, unit);
  if (c.a != c.b) all = swept(all, unit(c.b) - a);
  const std::optional<exact::Point> p = nearest(std::move(all), a);
  if (!p) return true;
  const exact::Integer reach = unit(c.radius) * p->denominator;
  return square(a * p->denominator - p->numerator) > reach * reach;
}

template <class A, class B>
bool apart_flat(const A& a, const B& b) {
  exact::Unit unit;
  fit(unit, a), fit(unit, b);
  exact::HalfSpaces all = halfspaces(a, unit);
  std::ranges::move(halfspaces(b, unit), std::back_inserter(all));
  return !nearest(std::move(all), {});
}

/// Of proper bounds, none of them everything.
struct ByIntegers {
  template <class A, class B>
  bool operator()(const A& a, const B& b) const {
    if constexpr (std::is_same_v<A, Everything> || std::is_same_v<B, Everything>) {
      return false;
    } else if constexpr (is_round<A> && is_round<B>) {
      const Capsule64 &p = as_capsule(a), &q = as_capsule(b);
      return compare_distance_by_integers({p.a, p.b}, {q.a, q.b}, p.radius, q.radius) > 0;
    } else if constexpr (is_round<A>) {
      return apart(b, as_capsule(a));
    } else if constexpr (is_round<B>) {
      return apart(a, as_capsule(b));
    } else {
      return apart_flat(a, b);
    }
  }
};

bool apart_boxes(const Box64& a, const Box64& b) {
  const auto before = [](const Vector64& high, const Vector64& low) {
    return high.x < low.x || high.y < low.y || high.z < low.z;
  };
  return before(a.high, b.low) || before(b.high, a.low);
}

bool apart(const Box64& b, const Sphere64& s) {
  // As in separate(Sphere64, Sphere64): differences are relative to u, and which of them counts is their
  // exact sign.
  const auto out = [](double low, double c, double high) { return std::max({low - c, 0.0, c - high}); };
  const double dx = out(b.low.x, s.x, b.high.x), dy = out(b.low.y, s.y, b.high.y),
               dz = out(b.low.z, s.z, b.high.z);
  const double q = dx * dx + dy * dy + dz * dz, t = s.radius * s.radius;
  constexpr double slack = 1 + 16 * 0x1p-53;
  if (t > 0x1p-900 && t < 0x1p1000 && q < 0x1p1000) {
    if (q > t * slack) return true;
    if (q * slack < t) return false;
  }
  return apart(b, capsule(s));
}

/// True when the box and the capsule are certainly on two sides of the plane between their nearest points,
/// roughly.
bool certainly_apart(const Box64& b, const Capsule64& c) {
  const Vector64 way{c.b.x - c.a.x, c.b.y - c.a.y, c.b.z - c.a.z};
  const double square = way.x * way.x + way.y * way.y + way.z * way.z;
  const Support box{AnyBound(b)}, round{AnyBound(c)};
  Vector64 p = c.a, q = c.a;
  for (int k = 0; k < 8; ++k) {
    q = {std::clamp(p.x, b.low.x, b.high.x), std::clamp(p.y, b.low.y, b.high.y),
         std::clamp(p.z, b.low.z, b.high.z)};
    const double t = (way.x * (q.x - c.a.x) + way.y * (q.y - c.a.y) + way.z * (q.z - c.a.z)) / square;
    const double s = t > 0 ? std::min(t, 1.0) : 0;  // of NaN, when it is a sphere: 0
    p = {c.a.x + s * way.x, c.a.y + s * way.y, c.a.z + s * way.z};
    const Vector64 d{p.x - q.x, p.y - q.y, p.z - q.z};
    if (box.along(d, q).high < round.along(d, q).low) return true;
  }
  return false;
}

/// True when one of the bound's slabs, if it has any, certainly leaves out all of the other.
bool certainly_leaves_out(const AnyBound& bound, const Support& other) {
  const auto* slabs = std::get_if<Slabs64>(&bound);
  return slabs && std::ranges::any_of(slabs->slabs, [&](const Slab& s) {
           const Range range = other.along(s.direction, slabs->origin);
           return range.high < s.low || s.high < range.low;
         });
}

/// True when the two, one of them slabs, are certainly on two sides of a plane: along one of the slabs, or
/// along an edge of either.
bool certainly_apart(const AnyBound& a, const AnyBound& b) {
  const Support p(a), q(b);
  if (certainly_leaves_out(a, q) || certainly_leaves_out(b, p)) return true;
  const auto* slabs = std::get_if<Slabs64>(&a);
  const Vector64 origin = slabs ? slabs->origin : std::get<Slabs64>(b).origin;
  const auto apart_along = [&](const Vector64& d) {
    const Range x = p.along(d, origin), y = q.along(d, origin);
    return x.high < y.low || y.high < x.low;
  };
  // The faces of a box have the directions of its edges.
  for (const auto& [bound, support] : {std::pair(&a, &p), std::pair(&b, &q)})
    if (std::holds_alternative<Box64>(*bound) && std::ranges::any_of(support->edges(), apart_along))
      return true;
  for (const Vector64& e : p.edges())
    for (const Vector64& f : q.edges())
      if (apart_along({e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x})) return true;
  return false;
}

/// As ByIntegers, by estimates where they are certain.
struct Apart {
  template <class A, class B>
  bool operator()(const A& a, const B& b) const {
    return ByIntegers{}(a, b);
  }
  bool operator()(const Sphere64& a, const Sphere64& b) const { return separate(a, b); }
  template <class A, class B>
  requires(is_round<A>&& is_round<B>) bool operator()(const A& a, const B& b) const {
    const Capsule64 &p = as_capsule(a), &q = as_capsule(b);
    return compare_distance({p.a, p.b}, {q.a, q.b}, p.radius, q.radius) > 0;
  }
  bool operator()(const Box64& a, const Box64& b) const { return apart_boxes(a, b); }
  bool operator()(const Box64& b, const Sphere64& s) const { return apart(b, s); }
  bool operator()(const Sphere64& s, const Box64& b) const { return apart(b, s); }
  bool operator()(const Box64& b, const Capsule64& c) const { return certainly_apart(b, c) || apart(b, c); }
  bool operator()(const Capsule64& c, const Box64& b) const { return (*this)(b, c); }
  template <class A>
  bool operator()(const A& a, const Slabs64& b) const {
    return certainly_apart(AnyBound(a), AnyBound(b)) || ByIntegers{}(a, b);
  }
  template <class B>
  bool operator()(const Slabs64& a, const B& b) const {
    return (*this)(b, a);
  }
  bool operator()(const Slabs64& a, const Slabs64& b) const {
    return certainly_apart(AnyBound(a), AnyBound(b)) || ByIntegers{}(a, b);
  }
};

bool comparable(const AnyBound& a, const AnyBound& b) {
  return proper(a) && proper(b) && !is_everything(a) && !is_everything(b);
}

}  // namespace

bool separate(const AnyBound& a, const AnyBound& b) { return comparable(a, b) && std::visit(Apart{}, a, b); }

bool separate_by_integers(const AnyBound& a, const AnyBound& b) {
  return comparable(a, b) && std::visit(ByIntegers{}, a, b);
}

}  // namespace catena::reference
