#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "catena/core/commands/command.h"
#include "catena/core/commands/frame_option.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/plan_options.h"
#include "catena/core/commands/plan_report.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/notice.h"
#include "catena/core/one_line.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/plan/search_plan.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"

namespace catena {
namespace {

/// `catena plan INPUT`: what the variant auto will do and leave out, and why; with --run what it did, and
/// what that took.
class PlanCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", input_, "A scene (path1:n=150000,frame=3) or a file (neuron.swc)").required();
    app.add_flag("--run", run_, "Search, and say what each step took and what was not done");
    frame_.add_to(app);
    want_.add_to(app);
    no_omit_.add_to(app);
    app.add_flag("--json", json_, "One JSON object a line for each frame");
    add_input_options(app, options_);
    add_tolerance_option(app, options_);
  }

  int run() override {
    const Input input = open_input(input_, options_);
    if (!input.boxes.empty() && !run_)
      throw InputError(
          input_ + ": what is searched in a box is known when it is searched; add --run, or say --box none");
    show_warnings(input);
    const Machine& machine = Machine::here();
    if (machine.warning) notice("catena", *machine.warning);
    const auto frames = frame_.of(input);
    const std::uint32_t first = frames.first, last = frames.second;
    Request request;
    request.want = want_.want();
    request.frames_follow = last - first > 1;
    // Of the scene, where the input is one frame of it.
    const std::uint32_t first_frame = written_frame(input_);

    auto variant = StrategyRegistry::instance().make(no_omit_.variant_that_times_planning());
    Periodic* const periodic = put_into_boxes(variant, input.boxes);
    variant->prepare(request);
    Collisions found;
    for (std::uint32_t f = first; f < last; ++f) {
      const Chain chain = input.animation->frame(f);
      if (!run_) {
        print(first_frame + f, chain,
              plan(chain.view(), request, machine, Omissions::without(no_omit_.names())), nullptr);
        continue;
      }
      go_to_frame(periodic, input.boxes, f);
      naming(fmt::format("{} frame {}", input_, first_frame + f), [&] {
        blaming("auto", [&] {
          f == first ? variant->build(chain)
                     : variant->update(chain, Moved::along(input.animation->shift(f)));
          variant->find(chain, request, found);
        });
      });
      print(first_frame + f, chain, variant->plan(), &found);
    }
    return 0;
  }

 private:
  /// `found` is null where nothing was searched.
  void print(std::uint32_t frame, const Chain& chain, const Plan& steps, const Collisions* found) const {
    if (json_) {
      nlohmann::ordered_json line{
          {"input", input_}, {"frame", frame}, {"n", chain.size()}, {"figures", Machine::here().source}};
      if (found != nullptr) line["collides"] = found->found;
      line["plan"] = to_json(steps);
      fmt::print("{}\n", json_line(line));
      return;
    }
    fmt::print("{} frame {}: {}{}\n{}", one_line(input_), frame, counted(chain.size(), "sphere"),
               found == nullptr ? ""
               : found->found   ? ", collides"
                                : ", does not collide",
               plan_table(steps, "  "));
  }

  std::string input_;
  FrameOption frame_;
  InputOptions options_{.takes_box = true};
  WantOptions want_;
  NoOmitOption no_omit_;
  bool run_ = false, json_ = false;
};

const RegisterCommand<PlanCommand> registered("plan",
                                              "What the variant auto leaves out for an input, and why");

}  // namespace
}  // namespace catena
