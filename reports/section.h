#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/reports/profile.h"

namespace catena::reports {

/// One part of the run file's `catena` object. A file in reports/sections/ registers it; nothing else knows
/// it.
struct Section {
  std::string name;  ///< its key
  /// What stands there; null or empty: left out.
  std::function<nlohmann::ordered_json(const Profile&)> measure;
};

/// All sections, sorted by name.
std::vector<Section> sections();

/// One object of this at namespace scope registers a section.
struct RegisterSection {
  RegisterSection(std::string name, std::function<nlohmann::ordered_json(const Profile&)> measure);
};

}  // namespace catena::reports
