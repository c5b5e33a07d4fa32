#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catena/core/commands/answer_files.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/frame_option.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/output_names.h"
#include "catena/core/commands/plan_options.h"
#include "catena/core/commands/plan_report.h"
#include "catena/core/commands/progress.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/one_line.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"

namespace catena {
namespace {

/// `catena detect INPUT`: builds, finds and says what was found, frame by frame.
class DetectCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", input_, "A scene (path1:n=150000,frame=3) or a file (neuron.swc)").required();
    app.add_option("--variant", variant_, "How to find the pairs; see catena list").capture_default_str();
    no_omit_.add_to(app);
    frame_.add_to(app);
    app.add_option(
        "--pairs", files_.pairs,
        "Write the colliding pairs to this file, with what identifies them in the input: CSV, or JSON lines "
        "where its name ends in .jsonl");
    app.add_option("--counts", files_.counts, "Write the collisions of each sphere to this file, likewise");
    app.add_flag("--depth", files_.depth, "--pairs has a column with the depth of the overlap");
    app.add_flag("--margin", files_.margin, "--pairs has a column with the margin, |q - t| / t");
    app.add_option("--pair-limit", request_.pair_limit,
                   "Most pairs to keep; more is an error with the true number")
        .whole_number()
        .capture_default_str();
    want_.add_to(app);
    app.add_flag("--plan", plan_, "Say what the variant left out of its work, and why; see catena plan");
    app.add_flag("--json", json_, "One JSON object a line for each frame");
    add_input_options(app, options_);
    add_tolerance_option(app, options_);
  }

  int run() override {
    check_options();
    auto variant = blaming(variant_, [&] { return StrategyRegistry::instance().make(variant_); });
    const Input input = open_input(input_, options_);
    show_warnings(input);
    Periodic* const periodic = put_into_boxes(variant, input.boxes);
    const auto frames = frame_.of(input);
    const std::uint32_t first = frames.first, last = frames.second;
    request_.frames_follow = last - first > 1;
    first_frame_ = written_frame(input_);
    AnswerFiles files(files_, input.labels);

    Progress progress(last - first);
    Collisions found;
    for (std::uint32_t f = first; f < last; ++f) {
      progress.step(fmt::format("frame {}", f));
      const Chain chain = input.animation->frame(f);
      go_to_frame(periodic, input.boxes, f);
      naming(fmt::format("{} frame {}", input_, first_frame_ + f), [&] {
        blaming(variant_, [&] {
          if (f == first) variant->prepare(request_);
          f == first ? variant->build(chain)
                     : variant->update(chain, Moved::along(input.animation->shift(f)));
          variant->find(chain, request_, found);
        });
      });
      progress.clear();
      print(f, input, chain, found, *variant);
      files.write(first_frame_ + f, chain, found, box_of(input.boxes, f));
    }
    files.close();
    return 0;
  }

 private:
  void check_options() {
    request_.want = want_.want();
    check_answer_options(request_, files_);
    leave_out_unread_pairs(request_, files_);
    require_apart(input_, options_.reading, {files_.pairs, files_.counts});
    if (no_omit_.given() && variant_ != usual_variant)
      throw InputError("--no-omit is about the variant auto; leave it out, or --variant");
    if (no_omit_.given()) variant_ = no_omit_.variant();
  }

  void print(std::uint32_t frame, const Input& input, const Chain& chain, const Collisions& found,
             const Variant& variant) const {
    const Timings t = variant.timings();
    const std::string by = variant.answered_by();
    const std::uint32_t most = found.count.empty() ? 0 : *std::ranges::max_element(found.count);
    if (json_) {
      nlohmann::ordered_json line{{"input", input_},
                                  {"frame", first_frame_ + frame},
                                  {"n", chain.size()},
                                  {"variant", variant_},
                                  {"collides", found.found}};
      if (const auto& thinning = input.thinning)
        line["thinned"] = {{"tolerance", thinning->tolerance},
                           {"of", thinning->spheres},
                           {"lost", thinning->lost},
                           {"own", thinning->own}};
      if (!by.empty()) line["answered_by"] = by;
      if (request_.want != Request::Want::any) line["pairs"] = found.pair_count, line["max_count"] = most;
      line["build_ms"] = t.build_ms;
      line["find_ms"] = t.find_ms;
      line["transfer_ms"] = t.transfer_ms;
      if (t.start_ms > 0) line["start_ms"] = t.start_ms;
      if (plan_) line["plan"] = to_json(variant.plan());
      fmt::print("{}\n", json_line(line));
      return;
    }
    const std::string what =
        request_.want == Request::Want::any
            ? (found.found ? "collides" : "does not collide")
            : fmt::format("{}, at most {} a sphere", counted(found.pair_count, "pair"), most);
    const auto also = [](const char* name, double ms) {
      return ms > 0 ? fmt::format(", {} {:.3f} ms", name, ms) : "";
    };
    fmt::print("{} frame {}: {}, {}; {}{}: build {:.3f} ms, find {:.3f} ms{}{}\n", one_line(input_),
               first_frame_ + frame, counted(chain.size(), "sphere"), what, variant_,
               by.empty() ? "" : ", " + by, t.build_ms, t.find_ms, also("transfer", t.transfer_ms),
               also("first start of the device", t.start_ms));
    if (plan_) fmt::print("{}", plan_table(variant.plan(), "  "));
  }

  static constexpr const char* usual_variant = "auto";

  std::string input_, variant_ = usual_variant;
  AnswerTables files_;
  FrameOption frame_;
  WantOptions want_;
  NoOmitOption no_omit_;
  InputOptions options_{.takes_box = true};
  std::uint32_t first_frame_ = 0;  ///< of the scene, where the input is one frame of it
  Request request_;
  bool json_ = false, plan_ = false;
};

const RegisterCommand<DetectCommand> registered("detect", "Find the self-collisions of a scene or file");

}  // namespace
}  // namespace catena
