#pragma once
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "catena/core/hierarchy/bound.h"

/// Bodies of integer coordinates whose extreme points are known exactly, as bounds of every kind: for tests
/// only.
namespace catena::reference::testing {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A power of two, of any size that leaves the squares of whole numbers room.
inline double any_scale() { return std::ldexp(1.0, *rc::gen::inRange(-900, 900)); }

struct Whole {
  std::int64_t x, y, z;
  friend Whole operator+(Whole a, Whole b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Whole operator-(Whole a, Whole b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Whole operator*(std::int64_t s, Whole a) { return {s * a.x, s * a.y, s * a.z}; }
  friend std::int64_t operator*(Whole a, Whole b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend bool operator==(Whole, Whole) = default;
  Whole mirrored() const { return {-y, z, x}; }  // an axis turned over, and all exchanged
  Vector64 scaled(double s) const {
    return {static_cast<double>(x) * s, static_cast<double>(y) * s, static_cast<double>(z) * s};
  }
};
inline Whole cross(Whole a, Whole b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Number>
Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

enum class Kind { sphere, capsule, box, slabs };

/// All points within `radius` of centre + the sum of s edge, -1 <= s <= 1, over its edges: none (sphere), one
/// (capsule), three along the axes (box), or more, not all in a plane (slabs). Boxes and slabs have no
/// radius.
struct Body {
  Kind kind;
  Whole centre;
  std::vector<Whole> edges;
  double radius = 0;
  Whole origin{0, 0, 0};      ///< of its slabs, from the centre
  std::vector<Whole> more{};  ///< directions of more slabs, which touch it and so change nothing

  Whole furthest(Whole direction) const {
    Whole p = centre;
    for (const Whole& e : edges) p = direction * e >= 0 ? p + e : p - e;
    return p;
  }
  Whole some_point(
      const std::array<int, 4>& sides) const {  // a corner, or between corners; sides of -1, 0, 1
    Whole p = centre;
    for (std::size_t k = 0; k < edges.size(); ++k) p = p + sides[k] * edges[k];
    return p;
  }
  Body moved(Whole by) const {
    Body b = *this;
    b.centre = b.centre + by;
    return b;
  }
  Body with_radius(double r) const {
    Body b = *this;
    b.radius = r;
    return b;
  }
  Body mirrored() const {
    Body b = *this;
    b.centre = centre.mirrored();
    b.origin = origin.mirrored();
    for (Whole& e : b.edges) e = e.mirrored();
    for (Whole& d : b.more) d = d.mirrored();
    return b;
  }
};

/// The body as a bound, times a power of two. Keeps the slabs, so it must outlive the bound.
class Shown {
 public:
  Shown(const Body& b, double scale) {
    const Vector64 c = b.centre.scaled(scale);
    const double r = b.radius * scale;
    if (b.kind == Kind::sphere) {
      bound_ = Sphere64{c.x, c.y, c.z, r};
    } else if (b.kind == Kind::capsule) {
      bound_ = Capsule64{(b.centre - b.edges[0]).scaled(scale), (b.centre + b.edges[0]).scaled(scale), r};
    } else if (b.kind == Kind::box) {
      Whole half{0, 0, 0};
      for (const Whole& e : b.edges) half = half + Whole{std::abs(e.x), std::abs(e.y), std::abs(e.z)};
      bound_ = Box64{(b.centre - half).scaled(scale), (b.centre + half).scaled(scale)};
    } else {
      std::vector<Whole> directions = b.more;
      for (std::size_t i = 0; i < b.edges.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (const Whole d = cross(b.edges[i], b.edges[j]); d != Whole{0, 0, 0}) directions.push_back(d);
      for (const Whole& d : directions) {
        std::int64_t reach = 0;
        for (const Whole& e : b.edges) reach += std::abs(d * e);
        const std::int64_t middle = -1 * (d * b.origin);
        slabs_.push_back({d.scaled(1), static_cast<double>(middle - reach) * scale,
                          static_cast<double>(middle + reach) * scale});
      }
      bound_ = Slabs64{(b.centre + b.origin).scaled(scale), slabs_};
    }
  }
  Shown(const Shown&) = delete;
  operator const AnyBound&() const { return bound_; }

 private:
  std::vector<Slab> slabs_;
  AnyBound bound_;
};

/// Three integer directions at right angles, each of the length that is returned last.
struct Frame {
  std::array<Whole, 3> axes;
  std::int64_t length;
};
inline Frame any_frame() {
  static const std::array<Frame, 4> frames{
      Frame{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1}, Frame{{{{1, 2, 2}, {2, 1, -2}, {2, -2, 1}}}, 3},
      Frame{{{{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}}, 7}, Frame{{{{0, 3, 4}, {0, -4, 3}, {5, 0, 0}}}, 5}};
  Frame f = frames[*rc::gen::inRange<std::size_t>(0, frames.size())];
  const int turns = *rc::gen::inRange(0, 6);
  for (int k = 0; k < turns; ++k)
    for (Whole& a : f.axes) a = a.mirrored();
  return f;
}
inline Whole any_whole(int most) {
  return {*rc::gen::inRange(-most, most + 1), *rc::gen::inRange(-most, most + 1),
          *rc::gen::inRange(-most, most + 1)};
}
inline Whole any_direction(int most) {
  const Whole d = any_whole(most);
  return d == Whole{0, 0, 0} ? Whole{1, 0, 0} : d;
}

inline Body any_body(Kind kind) {
  Body b{kind, any_whole(1000), {}};
  if (kind == Kind::capsule) b.edges = {any_whole(20)};
  if (kind == Kind::box) {
    const Whole h = any_whole(20);
    b.edges = {{h.x, 0, 0}, {0, h.y, 0}, {0, 0, h.z}};
  }
  if (kind == Kind::slabs) {
    if (*rc::gen::arbitrary<bool>()) {  // an oriented box
      for (const Whole& a : any_frame().axes) b.edges.push_back(*rc::gen::inRange(1, 20) * a);
    } else {
      b.edges = *rc::gen::suchThat(rc::gen::exec([] {
                                     return std::vector{any_direction(9), any_direction(9), any_direction(9)};
                                   }),
                                   [](const auto& e) { return cross(e[0], e[1]) * e[2] != 0; });
      if (*rc::gen::arbitrary<bool>()) b.edges.push_back(any_direction(9));
    }
    b.origin = any_whole(5);
    const int more = *rc::gen::inRange(-3, 6);
    for (int k = 0; k < more; ++k) b.more.push_back(any_direction(5));
  }
  return b;
}
inline Kind any_kind() { return *rc::gen::element(Kind::sphere, Kind::capsule, Kind::box, Kind::slabs); }
inline bool is_round(const Body& b) { return b.kind == Kind::sphere || b.kind == Kind::capsule; }

}  // namespace catena::reference::testing
