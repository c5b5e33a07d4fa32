#pragma once
#include "catena/core/sphere.h"

namespace catena {

/// True only when the spheres overlap for certain; free of calls and branches. Robust's stage 1 with a wider
/// slack: in binary32 q = |cA - cB|^2 has relative error <= 5.01u and t = (rA + rB)^2 <= 3.01u, u = 2^-24, and
/// where q underflows an absolute error below 2^-146, less than 2^-55 t; so 16u cover all where t is in range.
inline bool surely_overlap(const Sphere& a, const Sphere& b) {
  constexpr float slack = 1 + 0x1p-20f, least = 0x1p-90f, greatest = 0x1p120f;
  const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z, reach = a.radius + b.radius;
  const float q = dx * dx + dy * dy + dz * dz, t = reach * reach;
  return (t > least) & (t < greatest) & (q * slack < t);
}

}  // namespace catena
