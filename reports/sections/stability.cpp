#include <nlohmann/json.hpp>

#include "catena/bench/stability/report.h"
#include "catena/bench/stability/run.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// The stability matrix, every cell a line of `catena stability --json`.
nlohmann::ordered_json stability(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  if (profile.stability_n == 0) return rows;
  std::vector<std::string> names;
  for (const auto& variant : profile.variants) names.push_back(variant.name);
  for (const auto& spec : bench::stability_scenes(profile.stability_n))
    for (const auto& cell : bench::measure_scene(spec, names)) rows.push_back(bench::to_json(cell));
  return rows;
}

const RegisterSection registered{"stability", stability};

}  // namespace
}  // namespace catena::reports
