#pragma once
#include <span>

#include "catena/core/export.h"
#include "catena/core/sphere.h"

namespace catena {

/// A ball about all these spheres, in exact arithmetic, and nearly the smallest: the centre is that of the
/// smallest enclosing ball as binary64 finds it, rounded, and the radius is measured from there and rounded
/// up, so that the enclosure does not depend on the centre (properties/proofs/parent_binary64.g). Infinite
/// where it overflows. Never allocates; some ten passes over the spheres. At least one sphere.
///
/// A support of at most four spheres is kept; the sphere that sticks out farthest joins it, until none does
/// (Fischer and Gaertner, The smallest enclosing ball of balls, 2003, with the farthest sphere as the pivot).
CATENA_API Sphere enclosing_ball(std::span<const Sphere> spheres);

}  // namespace catena
