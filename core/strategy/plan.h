#pragma once
#include <optional>
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
  std::optional<double> estimate_ms = {};  ///< of the step, whether it is done or not
  std::optional<double> actual_ms = {};    ///< after a run, of what was done in its place
  std::string removed = {};                ///< after a run: what was not done, in numbers
};

/// What a variant decided for its last build and find, in the order of the steps; empty when it had no
/// choice.
using Plan = std::vector<Decision>;

}  // namespace catena
