#pragma once
#include <cmath>

#include "catena/core/scenes/random.h"
#include "catena/core/vec3.h"

namespace catena::bench {

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A rotation about the origin, as a quaternion of length 1 but for rounding. Plain expressions in a fixed
/// order: the same bits on every machine.
struct Rotation {
  double w = 1, x = 0, y = 0, z = 0;

  Vec3 operator()(const Vec3& v) const {
    const Vec3 axis{x, y, z};
    return v + 2.0 * cross(axis, cross(axis, v) + w * v);
  }
  /// This one after that one.
  Rotation after(const Rotation& b) const {
    return {w * b.w - x * b.x - y * b.y - z * b.z, w * b.x + x * b.w + y * b.z - z * b.y,
            w * b.y - x * b.z + y * b.w + z * b.x, w * b.z + x * b.y - y * b.x + z * b.w};
  }
  Rotation inverse() const { return {w, -x, -y, -z}; }
  Rotation normalised() const {
    const double scale = 1 / std::sqrt(w * w + x * x + y * y + z * z);
    return {scale * w, scale * x, scale * y, scale * z};
  }
};

/// Uniformly distributed over all rotations, by rejection from the cube.
inline Rotation random_rotation(Random& random) {
  for (;;) {
    const Rotation r{random.symmetric(), random.symmetric(), random.symmetric(), random.symmetric()};
    const double squared = r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z;
    if (squared > 0.01 && squared < 1) return r.normalised();
  }
}

/// A rotation, then a move.
struct RigidMove {
  Rotation turn;
  Vec3 shift;

  Vec3 operator()(const Vec3& v) const { return turn(v) + shift; }
};

/// A ball about centres of spheres; rounded to nearest, so it encloses them but for rounding.
struct CentreBall {
  Vec3 centre;
  double radius = 0;

  friend CentreBall join(const CentreBall& a, const CentreBall& b) {
    const Vec3 way = b.centre - a.centre;
    const double distance = length(way);
    if (distance + b.radius <= a.radius) return a;
    if (distance + a.radius <= b.radius) return b;
    const double radius = (distance + a.radius + b.radius) / 2;
    return {a.centre + ((radius - a.radius) / distance) * way, radius};
  }
  CentreBall moved(const RigidMove& move) const { return {move(centre), radius}; }
};

}  // namespace catena::bench
