#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/reports/journal.h"
#include "catena/reports/profile.h"

namespace catena::reports {

constexpr double unlimited_seconds = 1e9;  ///< of a timing that ends by its repetitions alone

/// Measures what the profile asks for, and gives it as a run file (reports/run_file.md). `command` is what
/// the user typed. All is kept in the journal as it is measured, and what that has already is not measured
/// again. Progress and what was left out go to stderr. Throws InputError in a build that is not Release, and
/// when nothing matches the filter.
nlohmann::ordered_json measure_run(const Profile& profile, const std::string& command, Journal& journal);
nlohmann::ordered_json measure_run(const Profile& profile, const std::string& command);  ///< keeps no journal

/// The run file's `variants`: what is known of each that was timed, and of each that stands under a key
/// "variant" in `sections`, at any depth. Throws InputError for a name of no variant.
nlohmann::ordered_json described_variants(const std::vector<VariantInfo>& timed,
                                          const nlohmann::ordered_json& sections);

/// Writes it whole or not at all. Throws InputError naming the file.
void write_run(const nlohmann::ordered_json& run, const std::string& file);

}  // namespace catena::reports
