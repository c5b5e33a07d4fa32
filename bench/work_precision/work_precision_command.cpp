#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/work_precision/json.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/somebody.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena work-precision`: error against run time, both from the same run.
class WorkPrecisionCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("TUBE", tubes_, "Tubes that are known exactly, see catena errors (default: lissajous)");
    app.add_option("--n", sizes_, "Spheres of the chain; repeatable (default: spacings 2, 1, 1/2, ... 1/16)")
        .type_name("N")
        .allow_extra_args(false)
        .range(std::uint32_t{8}, std::uint32_t{100'000'000});
    app.add_option(
           "--offset", offsets_,
           "Moves the chain along every axis, in radii; repeatable (default: 0 and 1e7, where rounded "
           "arithmetic shows)")
        .type_name("D")
        .allow_extra_args(false)
        .range(-1e30, 1e30);
    app.add_option("--tolerance", tolerances_,
                   "And as many spheres as lose at most this share of the radius; repeatable (default: 0.01, "
                   "unless --n)")
        .type_name("T")
        .allow_extra_args(false)
        .range(1e-6, 0.9);
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        .type_name("V")
        .allow_extra_args(false);
    app.add_option("--repetitions", repetitions_, "Timed rounds, each over all variants in random order")
        .capture_default_str()
        .range(1, 100000);
    app.add_flag("--json", json_, "One JSON object, in one line, with every point and the environment");
    app.footer("Build and find times of every variant on every scene: catena_bench, on Google Benchmark.");
  }

  int run() override {
    require_release_build();
    const auto tubes = tubes_named(tubes_);
    if (variants_.empty())
      for (const auto& info : StrategyRegistry::instance().variants())
        if (!info.unavailable) variants_.push_back(info.name);
    std::vector<VariantInfo> asked;
    for (const std::string& name : variants_) asked.push_back(StrategyRegistry::instance().describe(name));
    require_somebody(asked);
    bool measured = false;
    nlohmann::ordered_json out{{"environment", environment()}};
    for (const Tube& tube : tubes)
      for (const double offset : offsets_) {
        const auto result =
            work_precision(tube, sizes_of(tube), variants_, repetitions_, offset, tolerances());
        measured |= !result.points.empty();
        json_ ? add_to_json(out, result) : print_table(tube, offset, result);
      }
    if (!measured) throw InputError("nothing was measured: every variant was left out");
    if (json_) fmt::print("{}\n", json_line(out));
    return 0;
  }

 private:
  std::vector<std::uint32_t> sizes_of(const Tube& tube) const {
    if (!sizes_.empty()) return sizes_;
    std::vector<std::uint32_t> sizes;
    for (double spacing = 2; spacing > 1.0 / 20; spacing /= 2)
      sizes.push_back(static_cast<std::uint32_t>(std::ceil(tube.length / spacing)));
    return sizes;
  }

  std::vector<double> tolerances() const {
    return tolerances_.empty() && sizes_.empty() ? std::vector{0.01} : tolerances_;
  }

  static void print_table(const Tube& tube, double offset, const WorkPrecision& result) {
    fmt::print("{}, {:g} radii from the origin on every axis\n", tube.name, offset);
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
      if (p.tolerance) verdict += fmt::format("; tolerance {:g}", *p.tolerance);
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
    fmt::print("\n");
  }

  bool json_ = false;
  std::vector<std::string> tubes_{"lissajous"}, variants_;
  std::vector<std::uint32_t> sizes_;
  std::vector<double> tolerances_;
  std::vector<double> offsets_{0, 1e7};
  std::size_t repetitions_ = 21;
};

const RegisterCommand<WorkPrecisionCommand> registered{
    "work-precision", "Measure error against run time of every variant, with the Pareto front"};

}  // namespace
}  // namespace catena::bench
