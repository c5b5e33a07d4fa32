#pragma once
#include <span>

#include "catena/core/sphere.h"

namespace catena {

/// What a tube loses when of these consecutive spheres only the first and the last are kept: an upper bound,
/// in units of length, of the depth inside the tube to which points can lie in neither. The tube is every
/// sphere between two consecutive ones, centre and radius interpolated. At most the greatest radius, which is
/// what is lost of a gap.
///
/// With kept a, b, radii ra, rb, D = |b - a|; for a sphere (c, r) of the tube and any l from 0 to 1, m = a +
/// l (b - a) and R = ra + l (rb - ra): a point p at depth x, |p - c| <= r - x, that is in neither, has
///   R^2 + l (1 - l) (ra - rb)^2 = (1 - l) ra^2 + l rb^2 < (1 - l) |p - a|^2 + l |p - b|^2 = |p - m|^2 + l (1
///   - l) D^2,
/// and |p - m| <= R + g - x, where g = |c - m| + r - R. So there is none from x = R + g - sqrt(R^2 - l (1 -
/// l) K) on, K = D^2 - (ra - rb)^2. That is greatest for the smallest R, min(ra, rb); for l (1 - l) = 1/4;
/// and for the greatest g, which is met at one of the given spheres, for g is convex between two of them
/// where l is linear. What is left is the chord error g and the dip between neighbours. Where K / 4 > R^2
/// there is a gap.
///
/// At least two spheres. Rounding of binary64 is covered. O(spheres).
double tube_loss(std::span<const Sphere> spheres);

}  // namespace catena
