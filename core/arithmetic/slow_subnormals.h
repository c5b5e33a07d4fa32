#pragma once
#include "catena/core/export.h"

namespace catena {

/// Whether this machine multiplies numbers below the least normal one of binary32 by a detour, as Intel's
/// take some 150 cycles for each and AMD's hardly any. Measured at the first call, in some 50 us.
CATENA_API bool subnormals_are_slow();

}  // namespace catena
