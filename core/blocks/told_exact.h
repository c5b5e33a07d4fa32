#pragma once
#include <cstdint>

#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// What a search in binary32 says of the pairs of spheres that this left open, so many.
CATENA_API Decision told_exact(std::uint64_t open, float doubt);

/// "exact": open or all.
CATENA_API ParameterInfo exact_parameter();
/// See BlockTree::doubt.
CATENA_API float doubt_of(const Parameters& parameters);

}  // namespace catena
