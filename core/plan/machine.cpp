#include "catena/core/plan/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <locale>
#include <sstream>
#include <system_error>

#include "catena/core/executor/usable_cores.h"
#include "catena/core/never_destroyed.h"
#include "catena/core/strategy/registry.h"

namespace catena {
namespace {

constexpr const char* first_line = "catena-calibration 4";
constexpr const char* last_line = "end";

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  return processor_of(info);
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

/// So that no sum of them overflows, whatever the chain.
bool usable(double figure) { return figure >= 0 && figure <= 1e12; }

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
  std::error_code unknown;
  const auto type = std::filesystem::status(file, unknown).type();
  if (type != std::filesystem::file_type::regular && type != std::filesystem::file_type::not_found) {
    // To open a pipe would wait for whoever writes to it.
    if (!unknown)
      machine.warning = fmt::format("{} is no file; using built-in figures; catena calibrate needs its place",
                                    file.string());
    return machine;
  }
  std::ifstream text(file);
  if (!text) return machine;
  const Read found = read(text);
  const auto damaged = [&](const std::string& fault) {
    machine.warning =
        fmt::format("{} {}; using built-in figures; catena calibrate writes it anew", file.string(), fault);
    return machine;
  };
  if (!found.fault.empty()) return damaged(found.fault);
  Machine measured = machine;
  std::size_t known = 0;
  std::string fault;
  for (VariantCost& v : measured.costs) {
    const auto line = std::ranges::find(found.costs, v.variant, &VariantCost::variant);
    if (line == found.costs.end()) continue;
    if (v.cost.serial == 1 && line->cost.serial < 1)
      fault = fmt::format("has {} search by several threads, which it cannot", v.variant);
    v.cost = line->cost;
    ++known;
  }
  if (known == 0) fault = "has no variant's figures";
  if (!fault.empty()) return damaged(fault);
  measured.source = "figures of " + file.string();
  return measured;
}

const Machine& Machine::here() {
  static const Machine& machine = never_destroyed(from(calibration_file()));
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

std::string processor_of(std::istream& cpuinfo) {
  constexpr const char* numbers[] = {"CPU implementer", "CPU architecture", "CPU variant", "CPU part",
                                     "CPU revision",    "cpu model",        "cpu\t",       "uarch"};
  std::vector<std::string> told;
  std::string all;
  for (std::string line; std::getline(cpuinfo, line);) {
    const auto colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string value = line.substr(std::min(line.size(), colon + 2));
    if (line.starts_with("model name")) return value;
    // Of several processors each kind once.
    if (std::ranges::none_of(numbers, [&](const char* key) { return line.starts_with(key); }) ||
        std::ranges::count(told, line) > 0)
      continue;
    told.push_back(line);
    all += (all.empty() ? "" : " ") + value;
  }
  return all.empty() ? "unknown" : all;
}

std::string calibration_text(const Machine& machine) {
  std::string text = fmt::format("{}\nprocessor {}\n", first_line, processor());
  for (const Machine::VariantCost& v : machine.costs)
    text += fmt::format("{} {} {} {} {} {} {}\n", v.variant, v.cost.fixed_us, v.cost.sphere_ns,
                        v.cost.sphere_pair_ns, v.cost.serial, v.cost.team_us, v.cost.start_ms);
  return text + last_line + "\n";
}

}  // namespace catena
