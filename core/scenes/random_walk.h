#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/vec3.h"

namespace catena {

/// n points `step` apart, from the origin on: a walk that forgets its direction over the length
/// `persistence`. O(n).
std::vector<Vec3> random_walk(std::uint32_t n, double step, double persistence, Random random);

}  // namespace catena
