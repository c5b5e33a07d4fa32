#pragma once
#include <span>

#include "catena/core/strategy/registry.h"

namespace catena {

/// Throws InputError where none of the variants that were asked for can run here: nothing would be found out,
/// and that is no success. None asked for: all are.
void require_somebody(std::span<const VariantInfo> asked);

}  // namespace catena
