#pragma once
#include <cstdint>

#include "catena/core/export.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// What a plan says of a search that puts so many entries into an order in space: they were sorted for it, or
/// so many frames ago. See KeptOrder.
CATENA_API Decision told_order(std::uint32_t entries, std::uint32_t frames);

}  // namespace catena
