#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/progress.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/reference/verify.h"
#include "catena/reference/verify_inputs.h"
#include "catena/reference/verify_report.h"

namespace catena::reference {
namespace {

/// A variant to verify; it keeps its buffers from input to input, as it would in use.
struct Candidate {
  std::string name;
  bool rounded;  ///< literal or double: it may differ
  std::optional<std::string> unavailable;
  std::unique_ptr<Variant> variant;  ///< null when unavailable
};

/// literal and double keep the paper's formulas and may differ; everything else must be exact.
bool is_rounded(const std::string& name) {
  const auto slash = name.rfind('/');
  const std::string arithmetic = slash == std::string::npos ? "" : name.substr(slash + 1);
  return arithmetic == "literal" || arithmetic == "double";
}

Candidate candidate(const std::string& name) {
  Candidate result{name, is_rounded(name), std::nullopt, nullptr};
  try {
    result.variant = StrategyRegistry::instance().make(name);
  } catch (const CapacityError& why) {
    result.unavailable = why.what();
  }
  return result;
}

class VerifyCommand final : public Command {
 public:
  void configure(CLI::App& app) override {
    app.add_option("INPUT", inputs_, "Scenes and files; none: every scene, extremes and the sample files");
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        ->type_name("V")
        ->allow_extra_args(false);
    app.add_option("--frame", frame_, "Frame of an animated input, from 0, or all")->type_name("F|all");
    app.add_flag("--json", json_, "One JSON object a line for each input and variant");
    app.add_flag("--no-fcl", no_fcl_, "Leave FCL out");
    add_input_options(app, options_);
  }

  int run() override {
    const bool samples = inputs_.empty();
    if (samples) inputs_ = default_inputs();
    read_frame();
    auto candidates = make_candidates();

    std::vector<std::string> names;
    for (const auto& c : candidates) names.push_back(c.name);
    VerifyReport report(json_, inputs_, names);
    Progress progress(inputs_.size() * (candidates.size() + !no_fcl_));
    for (const auto& spec : inputs_) {
      const Input input = open_for_verification(spec, options_, samples);
      progress.clear();
      for (const auto& warning : input.warnings) fmt::print(stderr, "catena: {}: {}\n", spec, warning);
      const auto [first, last] = frames_of(input);
      for (std::uint32_t f = first; f < last; ++f) verify_frame(input, f, candidates, report, progress);
    }
    progress.clear();
    report.finish();
    return report.anything_wrong() ? 1 : 0;
  }

 private:
  static constexpr std::uint64_t pair_limit = std::uint64_t{1} << 24;  ///< beyond, counts are compared

  void read_frame() {
    if (frame_ == "all") return;
    const char* end = frame_.data() + frame_.size();
    const auto parsed = std::from_chars(frame_.data(), end, only_frame_);
    if (parsed.ec != std::errc{} || parsed.ptr != end)
      throw InputError(fmt::format("--frame {}: must be a frame number from 0, or all", frame_));
  }

  std::pair<std::uint32_t, std::uint32_t> frames_of(const Input& input) const {
    const std::uint32_t frames = input.animation->frames();
    if (frame_ == "all") return {0, frames};
    if (only_frame_ >= frames)
      throw InputError(
          fmt::format("{} has {} frames, from 0; there is no frame {}", input.name, frames, only_frame_));
    return {only_frame_, only_frame_ + 1};
  }

  std::vector<Candidate> make_candidates() const {
    std::vector<Candidate> candidates;
    if (variants_.empty())
      for (const auto& info : StrategyRegistry::instance().variants())
        candidates.push_back(candidate(info.name));
    for (const auto& name : variants_) candidates.push_back(candidate(name));
    return candidates;
  }

  void verify_frame(const Input& input, std::uint32_t frame, std::vector<Candidate>& candidates,
                    VerifyReport& report, Progress& progress) const {
    const Chain chain = input.animation->frame(frame);
    const Answer exact = exact_answer(chain, pair_limit);
    const auto print = [&](const std::string& variant, Verification result) {
      progress.clear();
      report.row({input.name, frame, chain.size(), exact.pair_count, variant, std::move(result)});
    };
    for (auto& c : candidates) {
      progress.step(fmt::format("{} on {}", c.name, input.name));
      if (c.variant) {
        print(c.name, verify(*c.variant, c.rounded, chain, exact));
      } else {
        Verification v;
        v.verdict = Verdict::unavailable;
        v.reason = *c.unavailable;
        print(c.name, std::move(v));
      }
    }
    if (no_fcl_) return;
    progress.step(fmt::format("FCL on {}", input.name));
    print("FCL", verify_fcl(chain, exact));
  }

  std::vector<std::string> inputs_, variants_;
  std::string frame_ = "0";
  std::uint32_t only_frame_ = 0;
  bool json_ = false, no_fcl_ = false;
  InputOptions options_;
};

const RegisterCommand<VerifyCommand> registered{
    "verify", "Hold every variant, and FCL, against the exact reference: pairs, counts and enclosure"};

}  // namespace
}  // namespace catena::reference
