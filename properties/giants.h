#pragma once
#include <vector>

#include "catena/properties/property.h"

namespace catena::properties {

/// Chains of more than 2^16 spheres, for every run of the properties: what is kept in 16 bits, be it the
/// number of a sphere, a node or a strand, goes wrong on them and on nothing shorter. A search takes
/// milliseconds, as hardly anything collides. Made once.
const std::vector<Case>& giants();

}  // namespace catena::properties
