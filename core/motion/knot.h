#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/motion/rope.h"
#include "catena/core/scenes/random.h"

namespace catena::motion {

/// n points, each `spacing` from the last, in the middle of a loose overhand knot tied along x: an open
/// trefoil of about 60 radii, nowhere nearer to itself than 1.3 diameters, with straight ends. A rope too
/// short for the knot is the arc in its middle. O(n).
std::vector<Vec3> overhand_knot(std::uint32_t n, double spacing);

/// Spheres at spacing 1 that reach from one end of the knot to the other: with fewer there is none.
inline constexpr std::uint32_t least_knot = 42;

/// Ropes whose roots are this far apart across x do not meet while their knots are pulled.
inline constexpr double knot_room = 32;

/// Adds such a rope about `root` to a start, with a small random velocity of each sphere, so that no two
/// ropes move alike.
void add_knotted_rope(RopeMotion::Start& start, std::uint32_t n, double spacing, const Vec3& root,
                      Random& random);

}  // namespace catena::motion
