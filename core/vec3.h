#pragma once
#include <cmath>

namespace catena {

/// A point or direction, binary64; of a scene in its working units (the sphere radius is 1). Plain
/// expressions in a fixed order, so that a scene has the same bits on every machine.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
};

}  // namespace catena
