#pragma once
#include "catena/core/sphere.h"
#include "catena/core/vec3.h"

namespace catena {

/// From the centre of one sphere to that of another, in the user's unit, each coordinate rounded once to
/// binary64.
inline Vec3 step_between(const Sphere& a, const Sphere& b) {
  return {double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
}

}  // namespace catena
