#pragma once
#include "catena/core/blocks/block_tree.h"
#include "catena/core/blocks/crowding.h"
#include "catena/core/export.h"
#include "catena/core/parameters/parameters.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// What a search by blocks says of its nodes, of which those in a row are not searched within; `crowding`, if
/// any, are left to another search.
CATENA_API Decision told_rows(const BlockTree& tree, const Crowding* crowding = nullptr);

/// "rows": skip or search them.
CATENA_API ParameterInfo rows_parameter();
/// Whether "rows" says skip. Throws InputError for a word that is neither.
CATENA_API bool skips_rows(const Parameters& parameters);

}  // namespace catena
