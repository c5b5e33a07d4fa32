#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "catena/reports/profile.h"

namespace catena::reports {

/// Measures what the profile asks for, and gives it as a run file (reports/run_file.md). `command` is what
/// the user typed. Progress and what was left out go to stderr. Throws InputError in a build that is not
/// Release, and when nothing matches the filter.
nlohmann::ordered_json measure_run(const Profile& profile, const std::string& command);

/// Writes it whole or not at all. Throws InputError naming the file.
void write_run(const nlohmann::ordered_json& run, const std::string& file);

}  // namespace catena::reports
