#include <fmt/format.h>

#include <numeric>
#include <string>

#include "catena/bench/ranks/scaling.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/counted.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/one_line.h"

namespace catena::ranks {
namespace {

/// `catena scaling INPUT`: what ranks would have to tell one another, before there are any.
class ScalingCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", input_, "A scene or a file, of what moves the first frame").required();
    app.add_option("--ranks", most_, "Up to so many, by doubling from 2")
        .range(2, 4096)
        .capture_default_str();
    app.add_option("--order", order_, "How spheres are shared out: in chain order, by space, or as measured")
        .one_of(parts::order_names())
        .capture_default_str();
    app.add_option("--timed", timed_,
                   "Search the parts, too, by this variant, from one rank on, and tell with --json what each "
                   "phase takes");
    add_input_options(app, options_);
    app.add_flag("--json", json_, "One JSON object");
  }

  int run() override {
    const Input input = open_input(input_, options_);
    show_warnings(input);
    const Chain chain = input.animation->frame(0);
    std::vector<unsigned> ranks = doubled_ranks(most_);
    if (!timed_.empty()) ranks.insert(ranks.begin(), 1);
    const Scaling scaling = measure_scaling(
        chain, {.ranks = ranks, .order = parts::order_named(order_), .timed_variant = timed_});
    if (json_) {
      nlohmann::ordered_json line{{"input", input_}, {"frame", written_frame(input_)}, {"n", chain.size()}};
      line.update(to_json(scaling));
      fmt::print("{}\n", json_line(line));
      return 0;
    }
    fmt::print("{}: {}; of a rank that has the most, and blocks asked for over blocks that truly touch\n",
               one_line(input_), counted(chain.size(), "sphere"));
    const auto ms = [&](const std::string& text) {
      return timed_.empty() ? "" : fmt::format(" {:>9}", text);
    };
    fmt::print("{:>6} {:>6} {:>10} {:>9} {:>7} {:>8} {:>7} {:>12} {:>9}{}\n", "ranks", "order", "spheres",
               "partners", "rounds", "blocks", "excess", "bytes", "messages", ms("ms"));
    for (const ScalingPoint& p : scaling.points)
      fmt::print("{:>6} {:>6} {:>10} {:>9} {:>7} {:>8} {:>7} {:>12} {:>9}{}\n", p.ranks,
                 p.in_space ? "space" : "chain", p.most_spheres, p.most_partners, p.most_rounds,
                 p.most_blocks_asked,
                 p.blocks_touching == 0 ? "-"
                                        : fmt::format("{:.2f}", static_cast<double>(p.blocks_asked) /
                                                                    static_cast<double>(p.blocks_touching)),
                 p.most_bytes, p.most_messages, ms(fmt::format("{:.2f}", slowest_ms(p))));
    if (!timed_.empty())
      fmt::print("ms: processor time of the slowest rank in each phase, all phases together\n");
    if (const auto law = scaling.surface())
      fmt::print("blocks asked for grow as (blocks held)^{:.2f}, between {:.2f} and {:.2f}\n", law->exponent,
                 law->low, law->high);
    if (scaling.stops_at() > 0)
      fmt::print("from {} ranks on, one asks for more blocks than it holds\n", scaling.stops_at());
    return 0;
  }

 private:
  static double slowest_ms(const ScalingPoint& p) {
    return std::accumulate(p.most_ms.begin(), p.most_ms.end(), 0.0);
  }

  std::string input_, order_ = parts::order_names().front(), timed_;
  unsigned most_ = 64;
  InputOptions options_;
  bool json_ = false;
};

const RegisterCommand<ScalingCommand> registered(
    "scaling", "What ranks would have to tell one another, counted up to 4096 of them");

}  // namespace
}  // namespace catena::ranks
