#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/error.h"
#include "catena/core/notice.h"
#include "catena/core/output_file.h"
#include "catena/core/plan/calibrate.h"

namespace catena {
namespace {

/// `catena calibrate`: what searches cost on this machine, for the plans of `auto`.
class CalibrateCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_flag("--json", json_, "One JSON object, in one line");
  }

  int run() override {
    const std::filesystem::path file = calibration_file();
    if (file.empty())
      throw InputError("there is no folder for the figures: set XDG_CACHE_HOME or HOME to an absolute path");
    const Machine machine = calibrate();
    std::error_code fault;
    std::filesystem::create_directories(file.parent_path(), fault);
    if (fault)
      throw InputError(fmt::format("cannot make {}: {}", file.parent_path().string(), fault.message()));
    write_file(file, calibration_text(machine));
    json_ ? print_json(machine, file) : print_text(machine, file);
    return 0;
  }

 private:
  static void print_text(const Machine& machine, const std::filesystem::path& file) {
    fmt::print("{:<24} {:>12} {:>14} {:>12} {:>12} {:>12} {:>10}\n", "variant", "fixed, us", "a sphere, ns",
               "a pair, ns", "threads, us", "serial", "start, ms");
    for (const Machine::VariantCost& v : machine.costs)
      fmt::print("{:<24} {:>12.3g} {:>14.3g} {:>12.3g} {:>12.3g} {:>12.3g} {:>10.3g}\n", v.variant,
                 v.cost.fixed_us, v.cost.sphere_ns, v.cost.sphere_pair_ns, v.cost.team_us, v.cost.serial,
                 v.cost.start_ms);
    if (const std::uint32_t n = crossover(machine); n > 0)
      fmt::print("a hierarchy pays from {} spheres on\n", n);
    fmt::print("kept in {}\n", file.string());
    if (machine.cores == 1)
      notice("catena",
             "one core is at hand here: what threads save and cost was not measured, and is as built in");
    for (const std::string& variant : hardly_helped_by_threads(machine))
      notice("catena",
             fmt::format(
                 "{} took hardly less by {} cores than by one, as where other work keeps them busy; plans "
                 "will take one thread until calibrate is run again",
                 variant, machine.cores));
  }

  static void print_json(const Machine& machine, const std::filesystem::path& file) {
    nlohmann::ordered_json line{{"file", file.string()},
                                {"crossover", crossover(machine)},
                                {"hardly_helped", hardly_helped_by_threads(machine)},
                                {"costs", nlohmann::ordered_json::array()}};
    for (const Machine::VariantCost& v : machine.costs)
      line["costs"].push_back({{"variant", v.variant},
                               {"fixed_us", v.cost.fixed_us},
                               {"sphere_ns", v.cost.sphere_ns},
                               {"sphere_pair_ns", v.cost.sphere_pair_ns},
                               {"team_us", v.cost.team_us},
                               {"serial", v.cost.serial},
                               {"start_ms", v.cost.start_ms}});
    fmt::print("{}\n", json_line(line));
  }

  bool json_ = false;
};

const RegisterCommand<CalibrateCommand> registered(
    "calibrate", "Measure what searches cost on this machine, for the variant auto");

}  // namespace
}  // namespace catena
