#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/frame_option.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/progress.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/commands/somebody.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"
#include "catena/reference/find_in_box.h"
#include "catena/reference/verify.h"
#include "catena/reference/verify_inputs.h"
#include "catena/reference/verify_report.h"

namespace catena::reference {
namespace {

/// A variant to verify; it keeps its buffers from input to input, as it would in use.
struct Candidate {
  VariantInfo info;
  std::unique_ptr<Variant> variant;    ///< null when unavailable
  std::unique_ptr<Periodic> in_box{};  ///< made for the first input with a box
};

Candidate candidate(const std::string& name) {
  const auto& registry = StrategyRegistry::instance();
  Candidate result{registry.describe(name), nullptr};
  if (!result.info.unavailable) result.variant = blaming(name, [&] { return registry.make(name); });
  return result;
}

class VerifyCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", inputs_, "Scenes and files; none: every scene, extremes and the sample files");
    app.add_option("--variant", variants_, "Only this variant; repeatable")
        .type_name("V")
        .allow_extra_args(false);
    frame_.add_to(app);
    app.add_flag("--json", json_, "One JSON object a line for each input and variant");
    app.add_flag(
        "--certify", certify_,
        "Prove each answer by the variant's own evidence, where it has some; no reference is run for it");
    add_input_options(app, options_);
    add_tolerance_option(app, options_);
  }

  int run() override {
    const bool samples = inputs_.empty();
    if (samples) inputs_ = default_inputs();
    auto candidates = make_candidates();
    std::vector<VariantInfo> asked;
    for (const Candidate& c : candidates) asked.push_back(c.info);
    require_somebody(asked);
    if (!samples) check_inputs(inputs_, options_), frame_.check(inputs_, options_);
    VerifyReport report(json_);
    Progress progress(inputs_.size() * candidates.size());
    for (const auto& spec : inputs_) {
      const Input input = open_for_verification(spec, options_, samples);
      progress.clear();
      show_warnings(input);
      const auto [first, last] = frame_.of(input);
      for (std::uint32_t f = first; f < last; ++f) verify_frame(input, f, candidates, report, progress);
    }
    progress.clear();
    report.finish();
    if (report.anything_wrong()) return 1;
    if (report.undecided() > 0) throw Undecided(report.undecided());
    return 0;
  }

 private:
  static constexpr std::uint64_t pair_limit = std::uint64_t{1} << 24;  ///< beyond, counts are compared

  std::vector<Candidate> make_candidates() const {
    std::vector<Candidate> candidates;
    if (variants_.empty())
      for (const auto& info : StrategyRegistry::instance().variants())
        candidates.push_back(candidate(info.name));
    for (const auto& name : variants_) {
      Candidate one = candidate(name);
      const auto same = [&](const Candidate& other) { return other.info.name == one.info.name; };
      if (std::ranges::none_of(candidates, same)) candidates.push_back(std::move(one));
    }
    return candidates;
  }

  void verify_frame(const Input& input, std::uint32_t frame, std::vector<Candidate>& candidates,
                    VerifyReport& report, Progress& progress) const {
    const Chain chain = input.animation->frame(frame);
    const PeriodicBox* const box = box_of(input.boxes, frame);
    const std::uint32_t first_frame = written_frame(input.name);
    std::optional<Answer> found;  // only when somebody needs it: a certificate does without
    const auto exact = [&]() -> const Answer& {
      if (!found && box)
        found = naming(fmt::format("{} frame {}", input.name, first_frame + frame),
                       [&] { return find_in_box(chain, *box, pair_limit); });
      if (!found) found = exact_answer(chain, pair_limit);
      return *found;
    };
    const auto print = [&](const VariantInfo& variant, std::uint64_t exact_pairs, Verification result) {
      progress.clear();
      report.row({input.name, first_frame + frame, chain.size(), exact_pairs, variant, std::move(result)});
    };
    for (auto& c : candidates) {
      progress.step(fmt::format("{} on {}", c.info.name, input.name));
      if (!c.variant) {
        Verification v;
        v.verdict = Verdict::unavailable;
        v.reason = *c.info.unavailable;
        print(c.info, certify_ ? 0 : exact().pair_count, std::move(v));
      } else if (box) {
        print(c.info, exact().pair_count, verify(in_box(c, *box), !c.info.exact, chain, exact()));
      } else if (certify_ && c.info.exact && has_evidence(*c.variant, chain)) {
        std::uint64_t proved;
        Verification v = verify_by_certificate(*c.variant, chain, pair_limit, proved);
        print(c.info, proved, std::move(v));
      } else {
        print(c.info, exact().pair_count, verify(*c.variant, !c.info.exact, chain, exact()));
      }
    }
  }

  static Variant& in_box(Candidate& c, const PeriodicBox& box) {
    if (!c.in_box)
      c.in_box = std::make_unique<Periodic>(
          blaming(c.info.name, [&] { return StrategyRegistry::instance().make(c.info.name); }), box);
    c.in_box->set_box(box);
    return *c.in_box;
  }

  std::vector<std::string> inputs_, variants_;
  FrameOption frame_;
  bool json_ = false, certify_ = false;
  InputOptions options_{.takes_box = true};
};

const RegisterCommand<VerifyCommand> registered{
    "verify",
    "Hold every variant, peers among them, against the exact reference: pairs, counts and enclosure"};

}  // namespace
}  // namespace catena::reference
