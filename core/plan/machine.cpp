#include "catena/core/plan/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <locale>
#include <sstream>

#include "catena/core/executor/usable_cores.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

constexpr const char* first_line = "catena-calibration 4";
constexpr const char* last_line = "end";

/// What tells one machine's figures from another's where a home is shared.
std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown";
}

/// The figures of the file's text, or why they cannot be used.
struct Read {
  std::vector<Machine::VariantCost> costs;
  std::string fault;
};

/// On a usual machine; sixteen threads of a Xeon took a fifth to a quarter of one's time, and 40 to 50 us to
/// come together.
MachineCost with_threads(const StrategyInfo& info) {
  constexpr double serial = 0.18, team_us = 45;
  const bool knows =
      std::ranges::find(info.parameters, "threads", &ParameterInfo::name) != info.parameters.end();
  return knows ? MachineCost{*info.cost, serial, team_us} : MachineCost{*info.cost};
}

bool usable(double figure) { return std::isfinite(figure) && figure >= 0; }

Read read(std::istream& text) {
  std::string line;
  if (!std::getline(text, line) || line != first_line) return {{}, "does not begin as a calibration does"};
  if (!std::getline(text, line) || line != "processor " + processor())
    return {{}, "was measured on another processor"};
  Read result;
  for (std::size_t number = 3; std::getline(text, line); ++number) {
    if (line == last_line) return result;
    std::istringstream fields(line);
    fields.imbue(std::locale::classic());
    Machine::VariantCost v;
    std::string rest;
    if (!(fields >> v.variant >> v.cost.fixed_us >> v.cost.sphere_ns >> v.cost.sphere_pair_ns >>
          v.cost.serial >> v.cost.team_us >> v.cost.start_ms) ||
        fields >> rest || !usable(v.cost.fixed_us) || !usable(v.cost.sphere_ns) ||
        !usable(v.cost.sphere_pair_ns) || !usable(v.cost.serial) || !usable(v.cost.team_us) ||
        !usable(v.cost.start_ms) || v.cost.serial > 1)
      return {{}, fmt::format("line {} is not a variant and six numbers", number)};
    result.costs.push_back(std::move(v));
  }
  return {{}, "is cut off"};
}

}  // namespace

Machine Machine::built_in() {
  Machine machine;
  const StrategyRegistry& registry = StrategyRegistry::instance();
  for (const std::string& name : registry.strategy_names()) {
    const StrategyInfo& info = registry.strategy(name);
    const bool on_device = info.place.on_device();
    if (!info.cost || info.peer || (!on_device && info.unavailable && info.unavailable())) continue;
    machine.costs.push_back(
        {name, with_threads(info), on_device, info.all_pairs, info.unavailable, info.started});
  }
  machine.cores = usable_cores();
  machine.source = "built-in figures; catena calibrate measures this machine's";
  return machine;
}

Machine Machine::from(const std::filesystem::path& file) {
  Machine machine = built_in();
  std::ifstream text(file);
  if (!text) return machine;
  const Read found = read(text);
  if (!found.fault.empty()) {
    machine.warning = fmt::format("{} {}; using built-in figures; catena calibrate writes it anew",
                                  file.string(), found.fault);
    return machine;
  }
  for (VariantCost& v : machine.costs)
    if (const auto measured = std::ranges::find(found.costs, v.variant, &VariantCost::variant);
        measured != found.costs.end())
      v.cost = measured->cost;
  machine.source = "figures of " + file.string();
  return machine;
}

const Machine& Machine::here() {
  static const Machine machine = from(calibration_file());
  return machine;
}

std::filesystem::path calibration_file() {
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* const value = std::getenv(name);
    return value != nullptr ? value : "";
  };
  std::filesystem::path cache = variable("XDG_CACHE_HOME");
  // The specification has a relative path ignored.
  if (!cache.is_absolute()) {
    const auto home = variable("HOME");
    if (!home.is_absolute()) return {};
    cache = home / ".cache";
  }
  return cache / "catena" / "calibration.txt";
}

std::string calibration_text(const Machine& machine) {
  std::string text = fmt::format("{}\nprocessor {}\n", first_line, processor());
  for (const Machine::VariantCost& v : machine.costs)
    text += fmt::format("{} {} {} {} {} {} {}\n", v.variant, v.cost.fixed_us, v.cost.sphere_ns,
                        v.cost.sphere_pair_ns, v.cost.serial, v.cost.team_us, v.cost.start_ms);
  return text + last_line + "\n";
}

}  // namespace catena
