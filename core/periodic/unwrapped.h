#pragma once
#include <span>
#include <vector>

#include "catena/core/chain/topology.h"
#include "catena/core/pair.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/sphere.h"

namespace catena {

/// Spheres that a box has cut apart as whole tubes, rounded to binary32: each step of a strand, and each
/// joint that ties a strand to one before it, goes to the nearest image. What arc lengths are measured on.
/// Throws InputError where that is not possible, as a closed strand or a loop winds around the box. O(spheres
/// + joints).
std::vector<Sphere> unwrapped(std::span<const Sphere> spheres, const Strands& strands,
                              std::span<const Pair> joints, const PeriodicBox& box);

}  // namespace catena
