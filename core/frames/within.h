#pragma once
#include "catena/core/sphere.h"

namespace catena {

/// The slack of within on a square, and the least and the greatest room for which it is proved.
inline constexpr float within_slack = 1 + 0x1p-20f, within_least = 0x1p-60f, within_greatest = 0x1p60f;

/// True only when sphere a lies within sphere b for certain: |ca - cb| <= rb - ra, the left side rounded up.
/// In binary32 the room m = rb - ra has relative error u = 2^-24, so m*m has 3.01u; q, the square of the
/// distance, has 5.01u, and where it underflows an absolute error below 2^-146, which is less than 2^-25 m*m
/// as m >= 2^-60. So a slack of 16u covers all: properties/proofs/within_binary32.g. m <= 2^60 keeps m*m
/// finite; an infinite q is not within.
inline bool within(const Sphere& a, const Sphere& b) {
  const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z, m = b.radius - a.radius;
  const float q = dx * dx + dy * dy + dz * dz;
  return (m >= within_least) & (m <= within_greatest) & (q * within_slack <= m * m);
}

}  // namespace catena
