#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/work_precision.h"
#include "catena/core/commands/command.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena work-precision`: error against run time, both from the same run.
class WorkPrecisionCommand final : public Command {
 public:
  void configure(CLI::App& app) override {
    app.add_option("TUBE", tube_, "A tube that is known exactly; see catena errors")->capture_default_str();
    app.add_option("--n", sizes_, "Spheres of the chain; repeatable (default: spacings 2, 1, 1/2, ... 1/16)")
        ->type_name("N")
        ->allow_extra_args(false)
        ->check(CLI::Range(std::uint32_t{8}, std::uint32_t{100'000'000}));
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        ->type_name("V")
        ->allow_extra_args(false);
    app.add_option("--repetitions", repetitions_, "Timed rounds, each over all variants in random order")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    app.add_option("--offset", offset_, "Moves the chain along every axis, in radii")->type_name("D");
    app.add_flag("--json", json_, "One JSON object with every point and the environment");
  }

  int run() override {
    const auto facts = environment();
    if (facts.at("build type") != "Release")
      throw InputError(
          fmt::format("this is a {} build; its times mean nothing. Configure with --preset release",
                      facts.at("build type")));
    const Tube tube = chosen();
    if (variants_.empty())
      for (const auto& info : StrategyRegistry::instance().variants())
        if (!info.unavailable) variants_.push_back(info.name);
    if (sizes_.empty())
      for (double spacing = 2; spacing > 1.0 / 20; spacing /= 2)
        sizes_.push_back(static_cast<std::uint32_t>(std::ceil(tube.length / spacing)));
    const WorkPrecision result = work_precision(tube, sizes_, variants_, repetitions_, offset_);
    json_ ? print_json(result, facts) : print_table(result);
    return 0;
  }

 private:
  Tube chosen() const {
    std::vector<std::string> known;
    for (const Tube& tube : known_tubes()) {
      if (tube.name == tube_) return tube;
      known.push_back(tube.name);
    }
    throw InputError(fmt::format("no tube is named '{}'; there are: {}", tube_, fmt::join(known, ", ")));
  }

  static void print_table(const WorkPrecision& result) {
    constexpr auto line = "{:>8}  {:<28} {:>10} {:>10} {:>10} {:>17}  {}\n";
    fmt::print(line, "n", "variant", "tube err.", "wrong", "median ms", "quartiles", "");
    std::size_t dominated = 0;
    for (const Point& p : result.points) {
      std::string verdict = "front";
      if (p.dominated_by) {
        const Point& better = result.points[*p.dominated_by];
        verdict = fmt::format("dominated by {}, n = {}", better.variant, better.n);
        ++dominated;
      }
      fmt::print(line, p.n, p.variant, fmt::format("{:.2e}", p.tube_error),
                 p.answer_error == 0 ? "0" : fmt::format("{:.1e}", p.answer_error),
                 fmt::format("{:.3f}", p.time.median),
                 fmt::format("{:.3f} .. {:.3f}", p.time.lower, p.time.upper), verdict);
    }
    fmt::print(
        "\n{} of {} points are on the Pareto front of tube error, share of wrong pairs and time; the others "
        "are beaten "
        "beyond\nthe spread.\n",
        result.points.size() - dominated, result.points.size());
    for (const auto& why : result.left_out) fmt::print("left out: {}\n", why);
  }

  static void print_json(const WorkPrecision& result, const std::map<std::string, std::string>& facts) {
    nlohmann::ordered_json out{{"environment", facts}, {"left_out", result.left_out}};
    auto& list = out["points"] = nlohmann::ordered_json::array();
    for (const Point& p : result.points) {
      list.push_back({{"tube", p.tube},
                      {"n", p.n},
                      {"variant", p.variant},
                      {"arithmetic", p.arithmetic},
                      {"tube_error", p.tube_error},
                      {"answer_error", p.answer_error},
                      {"repetitions", p.repetitions},
                      {"least_ms", p.time.least},
                      {"lower_quartile_ms", p.time.lower},
                      {"median_ms", p.time.median},
                      {"upper_quartile_ms", p.time.upper},
                      {"front", !p.dominated_by.has_value()}});
      if (p.dominated_by) list.back()["dominated_by"] = *p.dominated_by;
    }
    fmt::print("{}\n", out.dump(2));
  }

  std::string tube_ = "lissajous";
  std::vector<std::uint32_t> sizes_;
  std::vector<std::string> variants_;
  std::size_t repetitions_ = 21;
  double offset_ = 0;
  bool json_ = false;
};

const RegisterCommand<WorkPrecisionCommand> registered{
    "work-precision", "Error against run time of every variant, with the Pareto front"};

}  // namespace
}  // namespace catena::bench
