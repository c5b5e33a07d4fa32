#pragma once
#include <vector>

#include "catena/core/input/input.h"

namespace catena::test {

/// 3,000 spheres, dense with collisions.
inline Chain yarn() { return open_input("yarn:n=3000").animation->frame(0); }

/// Each moved that far along one axis, one way or the other.
inline std::vector<Sphere> shaken(std::vector<Sphere> spheres, float by) {
  for (std::size_t i = 0; i < spheres.size(); ++i) (&spheres[i].x)[i % 3] += i % 2 ? by : -by;
  return spheres;
}

}  // namespace catena::test
