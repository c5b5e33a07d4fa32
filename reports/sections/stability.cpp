#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "catena/bench/stability/report.h"
#include "catena/bench/stability/run.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// Between and beyond the settings of the matrix: where rounded arithmetic begins to lose pairs, by the
/// distance from the origin (log2 of radii) and by how near contacts are to touching.
constexpr std::array sweeps{"far:n={},exponent=23",     "far:n={},exponent=25",
                            "far:n={},exponent=26",     "far:n={},exponent=28",
                            "grazing:n={},margin=1e-5", "grazing:n={},margin=3e-7",
                            "grazing:n={},margin=3e-8", "grazing:n={},margin=1e-9"};

std::vector<std::string> scenes_of(const Profile& profile) {
  auto specs = bench::stability_scenes(profile.stability_n);
  for (const char* sweep : sweeps) specs.push_back(fmt::format(fmt::runtime(sweep), profile.stability_n));
  return specs;
}

/// The stability matrix, every cell a line of `catena stability --json`.
nlohmann::ordered_json stability(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  if (profile.stability_n == 0) return rows;
  std::vector<std::string> names;
  for (const auto& variant : profile.variants) names.push_back(variant.name);
  for (const auto& spec : scenes_of(profile))
    for (const auto& cell : bench::measure_scene(spec, names)) rows.push_back(bench::to_json(cell));
  return rows;
}

const RegisterSection registered{"stability", stability};

}  // namespace
}  // namespace catena::reports
