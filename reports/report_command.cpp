#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/reports/page_writer.h"
#include "catena/reports/profile.h"
#include "catena/reports/run_file.h"

namespace catena::reports {
namespace {

/// `catena report`: measures, keeps the raw samples and makes the page; or makes it of earlier runs.
class ReportCommand final : public Command {
 public:
  void configure(CLI::App& app) override {
    auto* quick = app.add_flag("--quick", quick_, "Under 3 minutes on 2 cores (default)");
    auto* full = app.add_flag("--full", full_, "Longer chains, narrower intervals; about an hour");
    auto* paper =
        app.add_flag("--paper", paper_, "The paper's Tables 3 and 4: both paths, its sizes, all keyframes");
    quick->excludes(full)->excludes(paper);
    full->excludes(paper);
    app.add_option("--output", output_, "Folder for run.json and the page")->capture_default_str();
    auto* from = app.add_option("--from", from_, "Measure nothing: make the page of these run files")
                     ->type_name("RUN.json");
    auto* compare = app.add_option("--compare", compare_,
                                   "Two run files, old and new: exit code 1 when something became slower")
                        ->type_name("OLD.json NEW.json")
                        ->expected(2);
    compare->excludes(from);
    app.add_option("--scene", scenes_, "Time this input instead; repeatable")
        ->type_name("INPUT")
        ->allow_extra_args(false);
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        ->type_name("V")
        ->allow_extra_args(false);
    app.add_option("--benchmark_filter", filter_,
                   "Only cases SCENE/n:N/VARIANT/STAGE that match, as Google Benchmark's")
        ->type_name("REGEX");
    app.add_option("--seconds", seconds_, "Limit of the timing")
        ->type_name("S")
        ->check(CLI::Range(1e-3, 1e6));
    app.add_option("--seed", seed_, "Of the random order of the measurements")->type_name("X");
    app.add_flag("--no-page", no_page_, "Write run.json only");
  }

  int run() override {
    if (!compare_.empty()) return run_page_writer({"--compare", compare_[0], compare_[1]});
    if (from_.empty()) return measure();
    return write_page(from_);
  }

 private:
  static constexpr std::uint32_t most_shown = 20'000;  ///< spheres of a chain in the viewer

  int measure() {
    const Profile profile = chosen();
    std::error_code failed;
    std::filesystem::create_directories(output_, failed);
    if (failed) throw InputError(fmt::format("cannot make the folder {}: {}", output_, failed.message()));
    const std::string file = (std::filesystem::path(output_) / "run.json").string();
    write_run(measure_run(profile, command()), file);
    fmt::print("{}: the raw samples of every measurement\n", file);
    std::fflush(stdout);  // before what the page writer says
    return no_page_ ? 0 : write_page({file});
  }

  int write_page(const std::vector<std::string>& runs) const {
    std::vector<std::string> arguments{"--output", output_};
    arguments.insert(arguments.end(), runs.begin(), runs.end());
    int code = 2;
    try {
      code = run_page_writer(arguments);
    } catch (const InputError& why) {
      throw InputError(fmt::format("{}{}", why.what(), from_.empty() ? "; " + kept(runs) : ""));
    }
    if (code != 0 && from_.empty()) fmt::print(stderr, "catena: no page was written; {}\n", kept(runs));
    return code;
  }

  std::string kept(const std::vector<std::string>& runs) const {
    return fmt::format("nothing measured is lost: catena report --output {} --from {}", output_,
                       fmt::join(runs, " "));
  }

  Profile chosen() const {
    Profile profile = profile_named(paper_ ? "paper" : full_ ? "full" : "quick");
    if (!scenes_.empty()) {
      profile.inputs.clear();
      for (const auto& scene : scenes_) profile.inputs.push_back({scene, paper_});
      about_inputs_only(profile);
    }
    if (!variants_.empty()) profile.variants = named_variants(), profile.filter.clear();
    if (!scenes_.empty() || !variants_.empty() || !filter_.empty()) profile.name = "custom";
    if (!filter_.empty()) profile.filter = filter_;
    if (seconds_ > 0) profile.stopping.seconds = seconds_, profile.whole_seconds = 0;
    profile.stopping.seed = seed_;
    return profile;
  }

  /// The sections that do not depend on the inputs are left out, the others are about these.
  void about_inputs_only(Profile& profile) const {
    profile.stability_n = 0;
    profile.motion_steps.clear(), profile.keyframe_sizes.clear();
    profile.tubes.clear(), profile.tube_spacings.clear(), profile.examine_settings.clear();
    profile.short_chains.clear(), profile.coherent_inputs.clear(), profile.shown.clear();
    profile.animation_input.clear();
    profile.wants_inputs = scenes_;
    for (const auto& scene : scenes_) {
      const auto animation = open_input(scene).animation;
      const bool moves = animation->frames() > 1;
      if (animation->frame(0).size() <= most_shown) profile.shown.push_back({scene, moves});
      if (!moves) continue;
      profile.coherent_inputs.push_back(scene);
      if (profile.animation_input.empty()) profile.animation_input = scene;
    }
  }

  /// A variant may be written with parameters, which the list of variants does not show.
  std::vector<VariantInfo> named_variants() const {
    std::vector<VariantInfo> chosen;
    for (const auto& name : variants_) {
      StrategyRegistry::instance().make(name);  // says what is wrong with it, or missing here
      chosen.push_back(StrategyRegistry::instance().describe(name));
    }
    return chosen;
  }

  std::string command() const {
    std::string text = fmt::format("catena report --{}", paper_ ? "paper" : full_ ? "full" : "quick");
    for (const auto& scene : scenes_) text += fmt::format(" --scene '{}'", scene);
    for (const auto& variant : variants_) text += fmt::format(" --variant '{}'", variant);
    if (!filter_.empty()) text += fmt::format(" --benchmark_filter '{}'", filter_);
    if (seconds_ > 0) text += fmt::format(" --seconds {}", seconds_);
    if (seed_ != 1) text += fmt::format(" --seed {}", seed_);
    return text;
  }

  bool quick_ = false, full_ = false, paper_ = false, no_page_ = false;
  std::string output_ = "catena-report", filter_;
  std::vector<std::string> from_, compare_, scenes_, variants_;
  double seconds_ = 0;
  std::uint64_t seed_ = 1;
};

const RegisterCommand<ReportCommand> registered{
    "report", "Measure every variant and make one page of it: times, errors, what is wrong, a viewer"};

}  // namespace
}  // namespace catena::reports
