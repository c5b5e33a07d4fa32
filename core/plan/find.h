#pragma once
#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// The self-collisions of a chain, by the variant `auto`. For one chain; a caller with many, or with frames
/// of one, holds a variant, which keeps its memory: StrategyRegistry::instance().make("auto"). Throws as
/// Variant::build and Variant::find do.
CATENA_API Collisions find(const Chain& chain, const Request& request = {});

}  // namespace catena
