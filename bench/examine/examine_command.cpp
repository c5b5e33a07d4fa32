#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/examine/json.h"
#include "catena/bench/timing/workload.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/one_line.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

/// `catena examine`: where the paper's parents do not enclose their children, and what that costs.
class ExamineCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option(
        "INPUT", inputs_,
        "Scenes and files, of what moves the middle frame; none: rod, path1 and yarn by n and offset");
    app.add_option("--arithmetic", arithmetics_, "literal or double; repeatable (default: both)")
        .allow_extra_args(false)
        .one_of({"literal", "double"});
    add_input_options(app, options_);
    app.add_flag("--levels", levels_, "A line for each level of the tree too");
    app.add_flag("--json", json_, "One JSON object a line for each input and arithmetic");
  }

  int run() override {
    if (inputs_.empty()) inputs_ = default_inputs();
    check_inputs(inputs_, options_);
    if (arithmetics_.empty()) arithmetics_ = {"literal", "double"};
    std::size_t width = 5;
    for (const auto& input : inputs_) width = std::max(width, input.size());
    bool begun = json_;
    for (const auto& spec : inputs_) {
      const Input input = open_input(spec, options_);
      show_warnings(input);
      if (!std::exchange(begun, true))
        fmt::print("{:<{}}  {:<10} {:>6} {:>8} {:>9} {:>10} {:>8} {:>8} {:>8} {:>8}\n", "input", width,
                   "arithmetic", "level", "parents", "failing", "shortfall", "pairs", "missing", "by tree",
                   "invented");
      const std::uint32_t middle = input.animation->frames() / 2;
      const Chain chain = input.animation->frame(middle);
      const auto exact = exact_answer(spec, chain);
      for (const auto& arithmetic : arithmetics_) {
        const Examination e = examine(arithmetic, chain, exact);
        if (!json_) {
          print(spec, width, arithmetic, exact, e);
          continue;
        }
        auto line = to_json(spec, arithmetic, exact, e);
        line["frame"] = written_frame(spec) + middle;
        print_line(line);
      }
    }
    if (!json_)
      fmt::print(
          "\nfailing: parents that do not enclose a child, in exact arithmetic; shortfall: the most that a "
          "child sticks "
          "out, over\nthe parent's radius; by tree: missing pairs that the same arithmetic finds when it is "
          "asked for "
          "them.\n");
    return 0;
  }

 private:
  static reference::Answer exact_answer(const std::string& spec, const Chain& chain) {
    try {
      return reference::find(chain);
    } catch (const PairLimitExceeded& exceeded) {
      throw TooManyPairs(spec, exceeded);
    }
  }

  static std::vector<std::string> default_inputs() {
    std::vector<std::string> inputs;
    for (const char* scene : {"rod", "path1", "yarn"}) {
      for (const char* n : {"1000", "10000", "100000"}) inputs.push_back(fmt::format("{}:n={}", scene, n));
      for (const char* offset : {"1e3", "1e5", "1e6", "1e7"})
        inputs.push_back(fmt::format("{}:n=10000,offset={}", scene, offset));
    }
    return inputs;
  }

  void print(const std::string& spec, std::size_t width, const std::string& arithmetic,
             const reference::Answer& exact, const Examination& e) const {
    const auto share = [](const LevelExamined& level) {
      return fmt::format("{:.2f} %", level.parents == 0 ? 0.0
                                                        : 100.0 * static_cast<double>(level.failing) /
                                                              static_cast<double>(level.parents));
    };
    fmt::print("{:<{}}  {:<10} {:>6} {:>8} {:>9} {:>10.1e} {:>8} {:>8} {:>8} {:>8}\n", one_line(spec), width,
               arithmetic, "all", e.all.parents, share(e.all), e.all.worst_shortfall, exact.pair_count,
               e.missing, e.lost_by_tree, e.invented);
    if (!levels_) return;
    for (const LevelExamined& level : e.levels)
      fmt::print("{:<{}}  {:<10} {:>6} {:>8} {:>9} {:>10.1e}\n", "", width, "", level.level, level.parents,
                 share(level), level.worst_shortfall);
  }

  static void print_line(const nlohmann::ordered_json& line) {
    fmt::print("{}\n", json_line(line));
  }

  std::vector<std::string> inputs_, arithmetics_;
  InputOptions options_;
  bool levels_ = false, json_ = false;
};

const RegisterCommand<ExamineCommand> registered{
    "examine", "Where the paper's parents do not enclose their children, by level, and the pairs lost by it"};

}  // namespace
}  // namespace catena::bench
