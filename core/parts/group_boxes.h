#pragma once
#include <cstdint>
#include <span>

#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/sphere.h"

namespace catena::parts {

/// Boxes around groups of `size` consecutive spheres, the last of which may be shorter.
void enclose_groups(std::span<const Sphere> spheres, std::uint32_t size, Box* boxes);

/// The same of a whole chain. O(n), shared out by the team.
LargeVector<Box> group_boxes(std::span<const Sphere> spheres, std::uint32_t size, const Team& team);

}  // namespace catena::parts
