#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "catena/bench/stability.h"
#include "catena/bench/stability_report.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/progress.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena stability`: the stability matrix.
class StabilityCommand final : public Command {
 public:
  void configure(CLI::App& app) override {
    app.add_option("INPUT", scenes_, "Scenes and files; none: every scene in each of its settings");
    app.add_option("--n", sizes_, "Spheres of the scenes; repeatable; without INPUT only (default 2000)")
        ->type_name("N")
        ->allow_extra_args(false)
        ->check(CLI::Range(std::uint32_t{1}, std::uint32_t{100'000'000}));
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        ->type_name("V")
        ->allow_extra_args(false);
    app.add_flag("--cells", cells_, "One line for each scene and variant, with the reason");
    app.add_flag("--json", json_, "One JSON object a line for each scene and variant");
  }

  int run() override {
    if (!scenes_.empty() && !sizes_.empty())
      throw InputError("--n sizes the scenes of the full matrix; write scene:n=N for a scene of your own");
    if (sizes_.empty()) sizes_ = {2000};
    if (scenes_.empty())
      for (const std::uint32_t n : sizes_)
        for (auto& spec : stability_scenes(n)) scenes_.push_back(std::move(spec));
    if (variants_.empty())
      for (const auto& info : StrategyRegistry::instance().variants()) variants_.push_back(info.name);
    const auto form = json_    ? StabilityReport::Form::json
                      : cells_ ? StabilityReport::Form::cells
                               : StabilityReport::Form::table;
    StabilityReport report(form, scenes_, variants_);
    Progress progress(scenes_.size() * variants_.size());
    for (const auto& spec : scenes_) {
      const auto cells = measure_scene(spec, progress);
      progress.clear();
      report.scene(cells);
    }
    report.finish();
    return report.any_defect() ? 1 : 0;
  }

 private:
  static constexpr std::uint64_t pair_limit = std::uint64_t{1} << 24;  ///< beyond, counts are compared
  static constexpr std::uint32_t most_all_pairs = 20'000;  ///< beyond, O(n^2) variants are left out

  std::vector<Cell> measure_scene(const std::string& spec, Progress& progress) const {
    const Input input = open_input(spec);
    const Chain chain = input.animation->frame(input.animation->frames() / 2);
    const reference::Answer exact = reference::exact_answer(chain, pair_limit);
    std::vector<Cell> cells;
    for (const auto& name : variants_) {
      progress.step(fmt::format("{} on {}", name, spec));
      try {
        const auto variant = StrategyRegistry::instance().make(name);
        if (chain.size() > most_all_pairs && compares_all_pairs(name))
          cells.push_back(unavailable(spec, name, chain, exact, "O(n^2): left out above 20,000 spheres"));
        else
          cells.push_back(measure(spec, name, *variant, chain, exact));
      } catch (const CapacityError& why) {
        cells.push_back(unavailable(spec, name, chain, exact, why.what()));
      }
    }
    return cells;
  }

  static bool compares_all_pairs(const std::string& name) {
    for (const auto& info : StrategyRegistry::instance().variants())
      if (info.name == name) return info.all_pairs;
    return false;
  }

  std::vector<std::string> scenes_, variants_;
  std::vector<std::uint32_t> sizes_;
  bool cells_ = false, json_ = false;
};

const RegisterCommand<StabilityCommand> registered{
    "stability", "Run every variant and arithmetic on stiff and extreme scenes: exact, wrong or not finite"};

}  // namespace
}  // namespace catena::bench
