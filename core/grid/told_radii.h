#pragma once
#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// What a search of so many spheres in cells says of their radii, whether it read one for all.
CATENA_API Decision told_radii(bool equal, std::uint64_t spheres);

/// "radii": once or each; see SphereGrid::each_radius.
CATENA_API ParameterInfo radii_parameter();
/// Whether "radii" says each. Throws InputError for a word that is neither.
CATENA_API bool reads_each_radius(const Parameters& parameters);

}  // namespace catena
