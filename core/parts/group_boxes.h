#pragma once
#include <cstdint>
#include <span>

#include "catena/core/executor/large_vector.h"
#include "catena/core/executor/team.h"
#include "catena/core/export.h"
#include "catena/core/hierarchy/box.h"
#include "catena/core/sphere.h"

namespace catena::parts {

/// A box around consecutive spheres, at least one, as the boxes of Box::around joined.
CATENA_API Box box_around(std::span<const Sphere> spheres);

/// Boxes around groups of `size` consecutive spheres, the last of which may be shorter.
void enclose_groups(std::span<const Sphere> spheres, std::uint32_t size, Box* boxes);

/// The same of a whole chain. O(n), shared out by the team.
LargeVector<Box> group_boxes(std::span<const Sphere> spheres, std::uint32_t size, const Team& team);

}  // namespace catena::parts
