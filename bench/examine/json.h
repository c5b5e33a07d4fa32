#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "catena/bench/examine/examine.h"

namespace catena::bench {

/// One line of `catena examine --json`. `exact` is what was examined against.
nlohmann::ordered_json to_json(const std::string& input, const std::string& arithmetic,
                               const reference::Answer& exact, const Examination& e);

}  // namespace catena::bench
