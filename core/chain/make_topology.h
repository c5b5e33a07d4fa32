#pragma once
#include <memory>
#include <vector>

#include "catena/core/chain/topology.h"
#include "catena/core/sphere.h"

namespace catena {

/// The topology of a chain of these spheres, which are valid. Throws InputError, naming strand or pair, like
/// Chain's constructor. O(n + p log p) for p extra pairs. Takes the arc lengths of an arc window where they
/// are `known`; else it measures them.
std::shared_ptr<const Topology> make_topology(const std::vector<Sphere>& spheres, Strands strands,
                                              Exclusion exclusion, ArcLengths* known = nullptr);

}  // namespace catena
