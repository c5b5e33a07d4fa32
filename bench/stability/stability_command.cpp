#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/stability/cell.h"
#include "catena/bench/stability/report.h"
#include "catena/bench/stability/run.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/progress.h"
#include "catena/core/commands/somebody.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/verify.h"

namespace catena::bench {
namespace {

/// `catena stability`: the stability matrix.
class StabilityCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option(
        "INPUT", scenes_,
        "Scenes and files, of what moves the middle frame; none: every scene in each of its settings");
    app.add_option("--n", sizes_, "Spheres of the scenes; repeatable; without INPUT only (default 2000)")
        .type_name("N")
        .allow_extra_args(false)
        .range(std::uint32_t{1}, std::uint32_t{100'000'000});
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        .type_name("V")
        .allow_extra_args(false);
    app.add_option("--seconds", limits_.seconds,
                   "Leave out a variant that is likely to take longer on a scene, by its growth")
        .type_name("S")
        .capture_default_str()
        .range(1e-3, 1e12);
    app.add_option("--overlaps", limits_.overlaps,
                   "Leave out a scene of which more spheres overlap, neighbours included")
        .type_name("P")
        .capture_default_str()
        .range(1e-3, 1e12);
    add_input_options(app, limits_.input);
    app.add_flag("--cells", cells_, "One line for each scene and variant, with the reason");
    app.add_flag("--json", json_, "One JSON object a line for each scene and variant");
  }

  int run() override {
    if (!scenes_.empty() && !sizes_.empty())
      throw InputError("--n sizes the scenes of the full matrix; write scene:n=N for a scene of your own");
    check_inputs(scenes_, limits_.input);
    if (sizes_.empty()) sizes_ = {2000};
    if (scenes_.empty())
      for (const std::uint32_t n : sizes_)
        for (auto& spec : stability_scenes(n)) scenes_.push_back(std::move(spec));
    if (variants_.empty())
      for (const auto& info : StrategyRegistry::instance().variants()) variants_.push_back(info.name);
    std::vector<VariantInfo> asked;
    for (const auto& name : variants_)  // an unknown name is said before anything is printed
      asked.push_back(StrategyRegistry::instance().describe(name));
    require_somebody(asked);
    std::vector<std::string> arithmetics;
    for (const VariantInfo& info : asked) arithmetics.push_back(info.arithmetic);
    const auto form = json_    ? StabilityReport::Form::json
                      : cells_ ? StabilityReport::Form::cells
                               : StabilityReport::Form::table;
    std::optional<StabilityReport> report;  // whose head comes before the first of its lines
    bool answered = false;
    std::uint64_t undecided = 0;
    Progress progress(scenes_.size() * variants_.size());
    for (const auto& spec : scenes_) {
      const auto cells = measure_scene(spec, variants_, limits_, [&](const std::string& name) {
        progress.step(fmt::format("{} on {}", name, spec));
      });
      progress.clear();
      if (!report) report.emplace(form, scenes_, variants_, arithmetics);
      report->scene(cells);
      answered |= std::ranges::any_of(
          cells, [](const Cell& c) { return c.answered && c.outcome != Outcome::unavailable; });
      undecided += static_cast<std::uint64_t>(std::ranges::count(cells, Outcome::undecided, &Cell::outcome));
    }
    report->finish();
    if (!answered) throw InputError("nothing was measured: every input or variant was left out");
    if (report->any_defect()) return 1;
    if (undecided > 0) throw reference::Undecided(undecided);
    return 0;
  }

 private:
  std::vector<std::string> scenes_, variants_;
  std::vector<std::uint32_t> sizes_;
  StabilityLimits limits_;
  bool cells_ = false, json_ = false;
};

const RegisterCommand<StabilityCommand> registered{
    "stability", "Run every variant and arithmetic on stiff and extreme scenes: exact, wrong or not finite"};

}  // namespace
}  // namespace catena::bench
