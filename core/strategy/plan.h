#pragma once
#include <string>
#include <vector>

#include "catena/core/export.h"

namespace catena {

/// One step of a search that a variant decided about: done or left out, and why, with the figure that
/// decided.
struct CATENA_API Decision {
  std::string step;
  bool left_out;
  std::string reason;
};

/// What a variant decided for its last build and find, in the order of the steps; empty when it had no
/// choice.
using Plan = std::vector<Decision>;

}  // namespace catena
