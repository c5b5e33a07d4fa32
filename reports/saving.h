#pragma once
#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "catena/reports/profile.h"

namespace catena::reports {

/// The measured side of one saving, a row of `savings`: the same answer with the work and without it, each in
/// milliseconds, in random turns.
nlohmann::ordered_json saving(const std::string& input, const std::string& what, const std::string& reason,
                              bool identical, const std::function<double()>& with,
                              const std::function<double()>& without, const Profile& profile);

/// What the variant auto leaves out, one omission after the other: with it switched off (`--no-omit`), and
/// without.
void add_planned_savings(nlohmann::ordered_json& rows, const Profile& profile);

}  // namespace catena::reports
