#pragma once
#include <cstdint>
#include <span>

#include "catena/core/vec3.h"

namespace catena::bench {

/// The determinant of the knot that is tied in an open polygon, its ends led away along x, the first towards
/// -infinity, and joined there: 1 without a knot, 3 for an overhand knot, 5 for a figure of eight, 9 for two
/// overhand knots. It does not change while the polygon moves without passing through itself; knots of one
/// determinant are not told apart. From the crossings of a projection, as the minor of the colouring matrix
/// (Livingston, Knot Theory, 1993, chapter 3). O(n^2 + crossings^3).
std::uint64_t knot_determinant(std::span<const Vec3> polygon);

}  // namespace catena::bench
