#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/margins/margins.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/frame_option.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/report_text.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/counted.h"
#include "catena/core/input/input.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/one_line.h"
#include "catena/core/periodic/periodic.h"

namespace catena::bench {
namespace {

/// `catena margins`: how near the decisions of any input are to changing their mind. What storing its numbers
/// changed can be said only where the numbers are known better than they are stored: `catena errors`.
class MarginsCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", inputs_, "Scenes (grazing:margin=1e-7) and files (neuron.swc)").required();
    frame_.add_to(app);
    add_input_options(app, options_);
    app.add_flag("--json", json_, "One JSON object a line for each frame");
    app.footer("What storing a tube in binary32 flips: catena errors.");
  }

  int run() override {
    check_inputs(inputs_, options_);
    frame_.check(inputs_, options_);
    for (const auto& spec : inputs_) {
      const Input input = open_input(spec, options_);
      show_warnings(input);
      const auto [first, last] = frame_.of(input);
      for (std::uint32_t frame = first; frame < last; ++frame) {
        const Chain chain = input.animation->frame(frame);
        const PeriodicBox* const box = box_of(input.boxes, frame);
        const std::uint32_t of_scene = written_frame(spec) + frame;
        const Margins m = naming(fmt::format("{} frame {}", spec, of_scene),
                                 [&] { return margins_of(chain, input.rounding, box); });
        json_ ? print_json(spec, of_scene, chain, box, m) : print(spec, of_scene, chain, box, m);
      }
    }
    return 0;
  }

 private:
  static void print(const std::string& spec, std::uint32_t frame, const Chain& chain, const PeriodicBox* box,
                    const Margins& m) {
    fmt::print("{} frame {}: {}, {}{}\n", one_line(spec), frame, counted(chain.size(), "sphere"),
               counted(m.colliding.pairs, "pair"),
               box ? "; between nearest images in the box " + written(*box) : "");
    if (m.rounding > 0)
      fmt::print("  reading rounded coordinates by up to {:.3g}, which leaves {} open\n", m.rounding,
                 counted(m.open_by_rounding, "pair"));
    if (std::isinf(m.least)) {
      fmt::print("  no pair has a margin below 1\n");
      return;
    }
    fmt::print("  smallest margin {:.3e}: spheres {} and {}, {}; condition number {:.3e}\n", m.least,
               m.tightest.i, m.tightest.j,
               m.least == 0          ? "touching"
               : m.tightest_collides ? "colliding"
                                     : "apart",
               m.condition_number());
    fmt::print("  binary32 leaves {} open, binary64 {}; {} touch exactly\n",
               counted(m.open_in_binary32, "pair"), m.open_in_binary64, m.touching);
    fmt::print("  {:<18} {:>12} {:>12}\n", "margin", "colliding", "apart");
    for (std::size_t k = 0; k < Margins::decades; ++k) {
      const auto colliding = m.colliding.decade[k], apart = m.apart.decade[k];
      if (colliding + apart == 0) continue;
      const std::string below = k == 0 ? "1" : fmt::format("1e-{:02}", k);
      fmt::print("  {:<18} {:>12} {:>12}\n",
                 k + 1 == Margins::decades ? "below " + below : fmt::format("1e-{:02} to {}", k + 1, below),
                 colliding, apart);
    }
  }

  static void print_json(const std::string& spec, std::uint32_t frame, const Chain& chain,
                         const PeriodicBox* box, const Margins& m) {
    nlohmann::ordered_json line{
        {"input", spec}, {"frame", frame}, {"n", chain.size()}, {"pairs", m.colliding.pairs}};
    if (box) line["box"] = written(*box);
    if (std::isfinite(m.least)) {
      line["least_margin"] = m.least;
      line["tightest"] = {m.tightest.i, m.tightest.j};
      line["tightest_collides"] = m.tightest_collides;
      line["condition_number"] = finite_or_word(m.condition_number());
    }
    line["touching"] = m.touching;
    line["open_in_binary32"] = m.open_in_binary32;
    line["open_in_binary64"] = m.open_in_binary64;
    line["rounding"] = m.rounding;
    line["open_by_rounding"] = m.open_by_rounding;
    line["colliding_decades"] = m.colliding.decade;
    line["apart_decades"] = m.apart.decade;
    fmt::print("{}\n", json_line(line));
  }

  std::vector<std::string> inputs_;
  FrameOption frame_;
  InputOptions options_{.takes_box = true};
  bool json_ = false;
};

const RegisterCommand<MarginsCommand> registered{
    "margins",
    "How near the decisions of any input are to changing their mind: margins and condition number"};

}  // namespace
}  // namespace catena::bench
