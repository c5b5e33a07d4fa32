#pragma once
#include <cmath>

#include "catena/core/cells/block_capsule.h"
#include "catena/core/hierarchy/bound.h"

namespace catena {

/// What a capsule is promised to hold: less than it is stored as (capsule_binary32.g).
inline Capsule64 promised(const BlockCapsule& c) {
  const double x = c.centre.x, y = c.centre.y, z = c.centre.z,
               half = std::hypot(c.half.x, c.half.y, c.half.z);
  return {{x - c.half.x, y - c.half.y, z - c.half.z},
          {x + c.half.x, y + c.half.y, z + c.half.z},
          c.radius - 0x1p-20 * (half + c.radius)};
}

}  // namespace catena
