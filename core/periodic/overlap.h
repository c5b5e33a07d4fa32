#pragma once
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/sphere.h"

namespace catena {

/// How deep two spheres overlap, ri + rj less the distance of their centres, and how near the decision is to
/// changing, |q - t| / t with q the squared distance and t = (ri + rj)^2. Both are those of the stored
/// numbers, computed by integers and then rounded: depth has the sign of the exact decision, and both are 0
/// where the spheres touch.
struct Overlap {
  double depth, margin;
};

/// In open space, or in one that a box repeats: then of the image of b that is nearest to a, for spheres that
/// collide in it (see Periodic). The box is one that check_box accepts, and a and b are less than 2^20 boxes
/// away. Of two points the margin is 0 or infinite.
/// Throws std::logic_error for two that do not collide in the box.
Overlap overlap_of(const Sphere& a, const Sphere& b, const PeriodicBox* box = nullptr);

}  // namespace catena
