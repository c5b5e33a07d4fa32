#pragma once
#include <cstdint>

#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// What a search by blocks says of its nodes, of which so many are in a row and are not searched within.
CATENA_API Decision told_rows(std::uint32_t rows, std::uint32_t nodes);

/// "rows": skip or search them.
CATENA_API ParameterInfo rows_parameter();
CATENA_API bool skips_rows(const Parameters& parameters);

}  // namespace catena
