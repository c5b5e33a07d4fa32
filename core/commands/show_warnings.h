#pragma once
#include "catena/core/input/input.h"

namespace catena {

/// Says on standard error what had to be assumed of an input, a line each.
void show_warnings(const Input& input);

}  // namespace catena
