#pragma once
#include "catena/core/scenes/snake.h"

namespace catena {

/// The paths of the paper's two scenes (Section 6, Fig. 12 and 13), in any unit.
SnakePath path1();  ///< a sinusoid out and back, crossing itself nine times
SnakePath path2();  ///< nine loops on a great circle, each crossing itself once

}  // namespace catena
