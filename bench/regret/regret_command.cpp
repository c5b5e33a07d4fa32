#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/regret/regret.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/progress.h"
#include "catena/core/commands/somebody.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/notice.h"
#include "catena/core/one_line.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena regret`: what the choice of auto costs beside the quickest single variant, at once and in the end.
class RegretCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", inputs_,
                   "Scenes and files, of what moves the middle frame; none: every scene at each --n");
    app.add_option("--n", sizes_,
                   "Spheres of the scenes; repeatable; without INPUT only (default 1000, 30000)")
        .type_name("N")
        .allow_extra_args(false)
        .range(std::uint32_t{1}, std::uint32_t{100'000'000});
    app.add_option("--variant", variants_,
                   "Hold auto against this one; repeatable (default: every one of the host)")
        .type_name("V")
        .allow_extra_args(false);
    app.add_option("--seconds", effort_.seconds, "About so long for each input, twice")
        .type_name("S")
        .capture_default_str()
        .range(1e-3, 1e6);
    app.add_option("--rounds", effort_.rounds, "Samples of each, at most")
        .capture_default_str()
        .range(std::size_t{1}, std::size_t{10'000});
    add_input_options(app, input_);
    app.add_flag("--json", json_, "One JSON object a line for each input");
    app.footer(
        "The first search of a variant that is made anew, as detect does it, and then the ratio of the same "
        "two after some 40 searches, by which auto has tried others than it chose. Times are the processor's "
        "where auto takes one thread of the host, and wall times where it does not.");
  }

  int run() override {
    if (!inputs_.empty() && !sizes_.empty())
      throw InputError(
          "--n sizes the scenes when no input is named; write scene:n=N for a scene of your own");
    const std::vector<WorkloadSpec> specs = asked();
    require_names_apart(specs);
    std::vector<VariantInfo> others;
    for (const std::string& name : variants_) others.push_back(StrategyRegistry::instance().describe(name));
    require_somebody(others);
    check_inputs(inputs_, input_);
    if (variants_.empty()) others = regret_variants(StrategyRegistry::instance().variants());
    std::size_t width = 5;
    for (const WorkloadSpec& spec : specs) width = std::max(width, label_of(spec).size());
    bool begun = json_;
    Progress progress(specs.size());
    std::vector<double> ratios, settled;
    for (const WorkloadSpec& spec : specs) {
      progress.step(spec.input);
      const Regret found = regret(spec, others, effort_);
      progress.clear();
      if (!found.left_out.empty()) {
        const std::string what = one_line(fmt::format("{} is left out: {}", found.input, found.left_out));
        if (specs.size() == 1) throw InputError(what);
        notice("catena regret", what);
        continue;
      }
      if (!std::exchange(begun, true))
        fmt::print("{:<{}}  {:<22} {:<22} {:>11} {:>11} {:>6} {:>6}  {}\n", "input", width,
                   "auto took at once", "quickest", "auto, ms", "quickest", "ratio", "later", "by");
      ratios.push_back(found.first_ratio()), settled.push_back(found.ratio());
      if (json_)
        fmt::print("{}\n", json_line(to_json(found)));
      else
        print(found, width);
      std::fflush(stdout);
    }
    if (ratios.empty()) throw InputError("nothing was measured: every input was left out");
    if (!json_) summarize("at once", ratios), summarize("later", settled);
    return 0;
  }

 private:
  std::vector<WorkloadSpec> asked() const {
    std::vector<WorkloadSpec> specs;
    for (const std::string& input : inputs_) specs.push_back({input, false, input_});
    if (!inputs_.empty()) return specs;
    for (const std::uint32_t n : sizes_.empty() ? std::vector<std::uint32_t>{1000, 30'000} : sizes_)
      for (WorkloadSpec& spec : all_scenes(n)) specs.push_back(std::move(spec));
    return specs;
  }

  static void print(const Regret& r, std::size_t width) {
    fmt::print("{:<{}}  {:<22} {:<22} {:>11.4g} {:>11.4g} {:>6.3f} {:>6.3f}  {}{}\n", one_line(r.input),
               width, r.first, r.best, r.first_median(), r.best_first_median(), r.first_ratio(), r.ratio(),
               r.chosen, r.processor ? "" : ", by the wall clock");
  }
  static void summarize(const char* when, const std::vector<double>& ratios) {
    double logs = 0;
    for (const double ratio : ratios) logs += std::log(ratio);
    fmt::print("{}: geometric mean {:.3f}, the most {:.3f}; above 1.05: {} of {}\n", when,
               std::exp(logs / static_cast<double>(ratios.size())), *std::ranges::max_element(ratios),
               std::ranges::count_if(ratios, [](double ratio) { return ratio > 1.05; }), ratios.size());
  }

  std::vector<std::string> inputs_, variants_;
  std::vector<std::uint32_t> sizes_;
  RegretEffort effort_;
  InputOptions input_{.takes_box = true};
  bool json_ = false;
};

const RegisterCommand<RegretCommand> registered{
    "regret", "What the choice of auto costs beside the quickest single variant, input by input"};

}  // namespace
}  // namespace catena::bench
