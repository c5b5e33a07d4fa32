#include "catena/reference/bounds/halfspaces.h"

#include <array>
#include <random>
#include <span>

namespace catena::reference::exact {
namespace {

bool violates(const Point& p, const HalfSpace& h) {
  return dot(h.normal, p.numerator) > h.reach * p.denominator;
}

/// The nearest point to p on the line in which the surfaces of i and j meet; `along` = their normals'
/// product, not 0.
std::optional<Point> nearest_on_line(const HalfSpace& i, const HalfSpace& j, const Vector& along,
                                     std::span<const HalfSpace> rest, const Vector& p) {
  // The line is (start + t along) / square(along), where start . along = 0, so the nearest of all has t = p .
  // along.
  const Integer q = square(along);
  const Vector start = cross(j.normal, along) * i.reach + cross(along, i.normal) * j.reach;
  struct Fraction {
    Integer n, d;  // d > 0
    bool operator<(const Fraction& o) const { return n * o.d < o.n * d; }
  };
  std::optional<Fraction> low, high;
  for (const HalfSpace& h : rest) {
    const Integer slope = dot(h.normal, along), room = h.reach * q - dot(h.normal, start);  // t slope <= room
    if (slope.is_zero()) {
      if (room < 0) return std::nullopt;
    } else if (slope > 0) {
      if (const Fraction end{room, slope}; !high || end < *high) high = end;
    } else if (const Fraction end{-room, -slope}; !low || *low < end) {
      low = end;
    }
  }
  if (low && high && *high < *low) return std::nullopt;
  Fraction t{dot(p, along), 1};
  if (low && t < *low) t = *low;
  if (high && *high < t) t = *high;
  return Point{start * t.d + along * t.n, q * t.d};
}

/// The nearest point to p on the surface of h, whose normal is not 0.
std::optional<Point> nearest_on_plane(const HalfSpace& h, std::span<const HalfSpace> rest, const Vector& p) {
  const Integer q = square(h.normal);
  std::optional<Point> best = Point{p * q - h.normal * (dot(h.normal, p) - h.reach), q};
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (!violates(*best, rest[k])) continue;
    const Vector along = cross(h.normal, rest[k].normal);
    if (along.zero()) return std::nullopt;  // parallel: all of the plane violates it
    best = nearest_on_line(h, rest[k], along, rest.first(k), p);
    if (!best) return best;
  }
  return best;
}

/// direction . (p - origin) <= end, of p in units.
HalfSpace halfspace(Vector64 direction, double end, const Vector& origin, const Unit& unit) {
  Unit own;
  own.fit(direction);
  Vector normal = own(direction);
  const Binary e(end);
  if (e.mantissa == 0) return {normal, dot(normal, origin)};
  const int shift = e.exponent - own.exponent() - unit.exponent();
  if (shift >= 0) return {normal, dot(normal, origin) + (Integer(e.mantissa) << shift)};
  normal = normal * (Integer(1) << -shift);
  return {normal, dot(normal, origin) + e.mantissa};
}

Vector64 negative(const Vector64& v) { return {-v.x, -v.y, -v.z}; }

}  // namespace

void fit(Unit& unit, const Box64& box) {
  for (const double end : {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z})
    if (std::isfinite(end)) unit.fit(end);
}
void fit(Unit& unit, const Slabs64& slabs) { unit.fit(slabs.origin); }

HalfSpaces halfspaces(const Slabs64& slabs, const Unit& unit) {
  const Vector origin = unit(slabs.origin);
  HalfSpaces all;
  all.reserve(2 * slabs.slabs.size());
  for (const Slab& s : slabs.slabs) {
    if (std::isfinite(s.high)) all.push_back(halfspace(s.direction, s.high, origin, unit));
    if (std::isfinite(s.low)) all.push_back(halfspace(negative(s.direction), -s.low, origin, unit));
  }
  return all;
}

HalfSpaces halfspaces(const Box64& box, const Unit& unit) {
  const std::array<Slab, 3> axes{Slab{{1, 0, 0}, box.low.x, box.high.x},
                                 Slab{{0, 1, 0}, box.low.y, box.high.y},
                                 Slab{{0, 0, 1}, box.low.z, box.high.z}};
  return halfspaces(Slabs64{{0, 0, 0}, axes}, unit);
}

bool contain(const HalfSpaces& all, const Vector& centre, const Integer& radius) {
  return std::ranges::all_of(all, [&](const HalfSpace& h) {
    const Integer room = h.reach - dot(h.normal, centre);  // must be >= radius |normal|
    return room >= 0 && room * room >= radius * radius * square(h.normal);
  });
}

HalfSpaces swept(const HalfSpaces& all, const Vector& way) {
  // normal . p + t slope <= reach for a t in [0, 1]. Each upper end of t must be at least each lower end.
  HalfSpaces result;
  struct End {
    Vector normal;
    Integer reach, slope;
  };
  std::vector<End> upper{{{}, 1, 1}}, lower{{{}, 0, 1}};  // of t; slope is its absolute value
  for (const HalfSpace& h : all) {
    const Integer slope = dot(h.normal, way);
    if (slope.is_zero()) {
      result.push_back(h);
    } else if (slope > 0) {
      upper.push_back({h.normal, h.reach, slope});
    } else {
      lower.push_back({h.normal, h.reach, -slope});
    }
  }
  for (const End& u : upper)
    for (const End& l : lower)
      result.push_back({u.normal * l.slope + l.normal * u.slope, u.reach * l.slope + l.reach * u.slope});
  return result;
}

std::optional<Point> nearest(HalfSpaces all, const Vector& p) {
  std::shuffle(all.begin(), all.end(), std::minstd_rand(1));
  std::optional<Point> best = Point{p, 1};
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!violates(*best, all[k])) continue;
    if (all[k].normal.zero()) return std::nullopt;
    best = nearest_on_plane(all[k], std::span(all).first(k), p);
    if (!best) return best;
  }
  return best;
}

}  // namespace catena::reference::exact
