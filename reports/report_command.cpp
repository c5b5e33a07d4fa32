#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/notice.h"
#include "catena/core/shell_word.h"
#include "catena/reports/faults.h"
#include "catena/reports/interrupted.h"
#include "catena/reports/journal.h"
#include "catena/reports/page_writer.h"
#include "catena/reports/profile.h"
#include "catena/reports/report_folder.h"
#include "catena/reports/run_file.h"

namespace catena::reports {
namespace {

using Json = nlohmann::ordered_json;

/// `catena report`: measures, keeps the raw samples and makes the page; or makes it of earlier runs.
class ReportCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    const auto quick = app.add_flag("--quick", quick_, "Under 3 minutes on 2 cores (default)");
    const auto full = app.add_flag("--full", full_, "Longer chains, narrower intervals; about an hour");
    const auto paper =
        app.add_flag("--paper", paper_, "The paper's Tables 3 and 4: both paths, its sizes, all keyframes");
    quick.excludes(full).excludes(paper);
    full.excludes(paper);
    app.add_option("--output", output_,
                   "Folder for run.json and the page; the run.json of an earlier run becomes run-1.json, ...")
        .capture_default_str();
    const auto from = app.add_option("--from", from_, "Measure nothing: make the page of these run files")
                          .type_name("RUN.json");
    const auto compare =
        app.add_option("--compare", compare_,
                       "Two run files, old and new: exit code 1 when something became slower")
            .type_name("OLD.json NEW.json")
            .expected(2);
    app.add_option("--scene", scenes_, "Time this input instead; repeatable")
        .type_name("INPUT")
        .allow_extra_args(false);
    add_input_options(app, input_);
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        .type_name("V")
        .allow_extra_args(false);
    app.add_option("--benchmark_filter", filter_,
                   "Only cases SCENE/n:N/VARIANT/STAGE that match, as Google Benchmark's")
        .type_name("REGEX");
    app.add_option("--seconds", seconds_, "Limit of the timing").type_name("S").range(1e-3, 1e6);
    app.add_option("--repetitions", repetitions_,
                   "Samples of every case, no fewer and no more, however long that takes (or --seconds)")
        .type_name("N")
        .range(1, 10'000);
    app.add_option("--seed", seed_, "Of the random order of the measurements").type_name("X").whole_number();
    const auto resume =
        app.add_flag("--resume", resume_, "Go on with the interrupted run of the folder, with its options");
    app.add_flag("--no-page", no_page_, "Write run.json only");
    // What they would not heed.
    app.exclude_others(resume, {"--output"});
    app.exclude_others(from, {"--output"});
    app.exclude_others(compare, {});
  }

  int run() override {
    if (!compare_.empty()) return run_page_writer({"--compare", compare_[0], compare_[1]});
    if (from_.empty()) return measure();
    ReportFolder folder(output_);
    const int code = write_page(from_);
    if (code == 0) folder.remove_earlier();
    return code;
  }

 private:
  static constexpr std::uint32_t most_shown = 20'000;  ///< spheres of a chain in the viewer

  int measure() {
    std::optional<Profile> asked;
    if (!resume_) asked = chosen();  // before anything is made: it may be refused
    ReportFolder folder(output_);
    if (resume_ && !std::filesystem::exists(folder.journal()) && std::filesystem::exists(folder.run_file()))
      throw InputError(fmt::format("{} holds a whole run, which nothing interrupted; its page: {}",
                                   folder.run_file(), page_of({folder.run_file()})));
    std::optional<Journal> resumed;
    if (resume_) take(options_of(*(resumed = Journal::resume(folder.journal()))));
    const Profile profile = asked ? *asked : chosen();
    Journal journal =
        resumed ? std::move(*resumed)
                : Journal::begin(folder.journal(), {{"options", options()}, {"environment", environment()}});
    Json run;
    try {
      const SaidIfInterrupted said("catena: interrupted; " + resumable());
      run = measure_run(profile, command(), journal);
    } catch (const std::exception& why) {
      if (journal.empty()) {  // nothing to go on with
        journal.remove();
        throw;
      }
      throw InputError(fmt::format("{}; {}", why.what(), resumable()));
    }
    if (const std::string kept = folder.keep_run(); !kept.empty())
      notice("catena", fmt::format("{} held an earlier run, which is now {}", folder.run_file(), kept));
    folder.remove_reports();
    write_run(run, folder.run_file());
    journal.remove();
    fmt::print("{}: the raw samples of every measurement\n", folder.run_file());
    std::fflush(stdout);  // before what the page writer says
    const int code = no_page_ ? 0 : write_page({folder.run_file()});
    if (!no_page_ && code == 0) folder.remove_earlier();
    return code == 0 && !noted_faults().empty() ? 1 : code;
  }

  std::string resumable() const {
    return fmt::format("what was measured is kept: catena report --resume --output {}", shell_word(output_));
  }

  Json options() const {
    return {{"profile", paper_  ? "paper"
                        : full_ ? "full"
                                : "quick"},
            {"scenes", scenes_},
            {"input", arguments_of(input_)},
            {"variants", variants_},
            {"filter", filter_},
            {"seconds", seconds_},
            {"repetitions", repetitions_},
            {"seed", seed_},
            {"no_page", no_page_}};
  }

  /// Those of an interrupted run, when this program on this machine can go on with it.
  static Json options_of(const Journal& journal) {
    const Json was = journal.run().at("environment"), is = environment();
    for (const auto& [fact, value] : is.items())
      if (was.value(fact, "") != value)
        throw InputError(
            fmt::format("--resume: the interrupted run had the {} '{}', this is '{}'; its samples do not mix",
                        fact, was.value(fact, ""), value.get<std::string>()));
    return journal.run().at("options");
  }

  void take(const Json& options) {
    const std::string profile = options.at("profile");
    paper_ = profile == "paper", full_ = profile == "full";
    options.at("scenes").get_to(scenes_), options.at("variants").get_to(variants_);
    read_input_options(options.value("input", std::vector<std::string>()), input_);
    options.at("filter").get_to(filter_), options.at("seconds").get_to(seconds_);
    options.at("repetitions").get_to(repetitions_), options.at("seed").get_to(seed_);
    options.at("no_page").get_to(no_page_);
  }

  int write_page(const std::vector<std::string>& runs) const {
    std::vector<std::string> arguments{"--output", output_};
    arguments.insert(arguments.end(), runs.begin(), runs.end());
    int code = 2;
    try {
      code = run_page_writer(arguments, from_.empty() ? kept(runs) : "");
    } catch (const InputError& why) {
      throw InputError(fmt::format("{}{}", why.what(), from_.empty() ? "; " + kept(runs) : ""));
    }
    if (code != 0 && from_.empty()) notice("catena", "no page was written; " + kept(runs));
    return code;
  }

  /// The command that makes the page of these runs.
  std::string page_of(const std::vector<std::string>& runs) const {
    std::string command = fmt::format("catena report --output {} --from", shell_word(output_));
    for (const std::string& run : runs) command += fmt::format(" {}", shell_word(run));
    return command;
  }

  std::string kept(const std::vector<std::string>& runs) const {
    return "nothing measured is lost: " + page_of(runs);
  }

  Profile chosen() const {
    Profile profile = profile_named(paper_ ? "paper" : full_ ? "full" : "quick");
    if (scenes_.empty() && !arguments_of(input_).empty())
      throw InputError(
          fmt::format("{} is said of an input; name it by --scene", arguments_of(input_).front()));
    if (!scenes_.empty()) {
      profile.inputs.clear();
      for (const auto& scene : scenes_) profile.inputs.push_back({scene, paper_, input_});
      about_inputs_only(profile);
    }
    if (!variants_.empty()) profile.variants = named_variants(), profile.filter.clear();
    if (!scenes_.empty() || !variants_.empty() || !filter_.empty()) profile.name = "custom";
    if (!filter_.empty()) profile.filter = filter_;
    if (repetitions_ > 0) {
      profile.stopping.most_samples = repetitions_, profile.stopping.share = 0;
      profile.stopping.seconds = unlimited_seconds, profile.whole_seconds = 0;
    }
    if (seconds_ > 0) profile.stopping.seconds = seconds_, profile.whole_seconds = 0;
    profile.stopping.seed = seed_;
    return profile;
  }

  /// The sections that do not depend on the inputs are left out, the others are about these.
  void about_inputs_only(Profile& profile) const {
    profile.stability_n = 0, profile.judged_steps = 0;
    profile.rank_chains.clear(), profile.long_inputs.clear();
    profile.motion_steps.clear(), profile.keyframe_sizes.clear();
    profile.tubes.clear(), profile.tube_spacings.clear(), profile.examine_settings.clear();
    profile.short_chains.clear(), profile.coherent_inputs.clear(), profile.shown.clear();
    profile.animation_input = {};
    profile.wants_inputs.clear(), profile.regret_inputs.clear();
    profile.planned_inputs.clear();
    if (in_command(input_).empty()) profile.planned_inputs = scenes_;  // they are opened without options
    for (const auto& scene : scenes_) {
      const bench::WorkloadSpec one{scene, false, input_};
      profile.wants_inputs.push_back(one), profile.regret_inputs.push_back(one);
      const auto animation = open_input(scene, input_).animation;
      const bool moves = animation->frames() > 1;
      const std::uint32_t spheres = animation->frame(0).size();
      if (spheres == 0 && !no_page_)
        throw InputError(fmt::format(
            "{} is a chain without spheres, of which there is no page; leave it out, or give --no-page",
            scene));
      if (0 < spheres && spheres <= most_shown) profile.shown.push_back({scene, moves, input_});
      if (!moves) continue;
      profile.coherent_inputs.push_back(one);
      if (profile.animation_input.input.empty()) profile.animation_input = one;
    }
  }

  /// A variant may be written with parameters, which the list of variants does not show.
  std::vector<VariantInfo> named_variants() const {
    std::vector<VariantInfo> chosen;
    for (const auto& name : variants_) {
      // Says what is wrong with it, or missing here.
      blaming(name, [&] { return StrategyRegistry::instance().make(name); });
      chosen.push_back(StrategyRegistry::instance().describe(name));
    }
    return chosen;
  }

  std::string command() const {
    std::string text = fmt::format("catena report --{}", paper_ ? "paper" : full_ ? "full" : "quick");
    for (const auto& scene : scenes_) text += " --scene " + shell_word(scene);
    text += in_command(input_);
    for (const auto& variant : variants_) text += " --variant " + shell_word(variant);
    if (!filter_.empty()) text += " --benchmark_filter " + shell_word(filter_);
    if (seconds_ > 0) text += fmt::format(" --seconds {}", seconds_);
    if (repetitions_ > 0) text += fmt::format(" --repetitions {}", repetitions_);
    if (seed_ != 1) text += fmt::format(" --seed {}", seed_);
    return text;
  }

  bool quick_ = false, full_ = false, paper_ = false, no_page_ = false, resume_ = false;
  std::string output_ = "catena-report", filter_;
  std::vector<std::string> from_, compare_, scenes_, variants_;
  double seconds_ = 0;
  std::uint64_t seed_ = 1;
  std::size_t repetitions_ = 0;
  InputOptions input_{.takes_box = true};
};

const RegisterCommand<ReportCommand> registered{
    "report", "Measure every variant and make one page of it: times, errors, what is wrong, a viewer"};

}  // namespace
}  // namespace catena::reports
