#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "catena/core/strategy/plan.h"

namespace catena {

/// A plan as a table, a step a line, each line beginning with `indent`; columns that no step fills are left
/// out.
std::string plan_table(const Plan& plan, const std::string& indent = "");

/// A plan as core/commands/json.md describes it.
nlohmann::ordered_json to_json(const Plan& plan);

}  // namespace catena
