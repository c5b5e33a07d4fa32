#pragma once
#include <nlohmann/json.hpp>

#include "catena/bench/work_precision/work_precision.h"

namespace catena::bench {

/// Adds the points of one run, and what was left out of it, to the lists "points" and "left_out" of `out`,
/// which it makes when they are not there. "dominated_by" is an index into "points".
void add_to_json(nlohmann::ordered_json& out, const WorkPrecision& result);

}  // namespace catena::bench
