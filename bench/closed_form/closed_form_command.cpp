#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "catena/bench/closed_form/lattice_box.h"
#include "catena/core/commands/command.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"

namespace catena::bench {
namespace {

/// `catena closed-form`: a chain whose pairs are known by a formula, at any size, without a reference.
class ClosedFormCommand final : public Command {
 public:
  void configure(CLI::App& app) override {
    app.add_option("--side", box_.side, "Points along each of three axes; side^3 spheres")
        ->check(CLI::Range(1, 1290))
        ->capture_default_str();
    app.add_option("--reach", box_.reach, "Spheres of points so many steps apart touch exactly")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    app.add_flag("--face-centred", box_.face_centred, "The face-centred lattice instead of the cubic one");
    app.add_flag("--rods", box_.rods, "A bundle: each row a strand of its own");
    app.add_option("--variant", variant_, "Who finds the pairs; see catena list")->capture_default_str();
    app.add_flag("--counts-only", counts_only_, "Compare counts, keep no pairs");
    app.add_flag("--json", json_, "One JSON object");
    app.footer(
        "The same chain as an input of any command: the scene serpentine. Exit code 1 for a wrong answer.");
  }

  int run() override {
    const auto variant = blaming(variant_, [&] { return StrategyRegistry::instance().make(variant_); });
    const Chain chain = open_input(box_.scene()).animation->frame(0);
    const Request request{.want = counts_only_ ? Request::Want::counts : Request::Want::pairs};
    Collisions found;
    blaming(variant_, [&] {
      variant->prepare(request);
      variant->build(chain);
      variant->find(chain, request, found);
    });
    const std::string wrong = fault(box_, found, !counts_only_);
    const Timings t = variant->timings();
    if (json_) {
      const nlohmann::ordered_json line{{"input", box_.scene()},
                                        {"n", chain.size()},
                                        {"variant", variant_},
                                        {"pairs", found.pair_count},
                                        {"closed_form", box_.pairs()},
                                        {"ties", box_.ties()},
                                        {"fault", wrong},
                                        {"build_ms", t.build_ms},
                                        {"find_ms", t.find_ms}};
      fmt::print("{}\n", line.dump());
    } else {
      fmt::print(
          "{}: {} spheres; closed form {} pairs, {} of them exact ties\n{}: {} pairs, {}; build {:.3f} ms, "
          "find "
          "{:.3f} ms\n",
          box_.scene(), chain.size(), box_.pairs(), box_.ties(), variant_, found.pair_count,
          wrong.empty() ? "right" : "WRONG: " + wrong, t.build_ms, t.find_ms);
    }
    return wrong.empty() ? 0 : 1;
  }

 private:
  LatticeBox box_;
  std::string variant_ = "Hybrid";
  bool counts_only_ = false, json_ = false;
};

const RegisterCommand<ClosedFormCommand> registered{
    "closed-form", "A chain full of exact ties, whose pairs a formula knows, at any size"};

}  // namespace
}  // namespace catena::bench
