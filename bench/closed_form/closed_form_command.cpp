#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "catena/bench/closed_form/lattice_options.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/counted.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"

namespace catena::bench {
namespace {

/// `catena closed-form`: a chain whose pairs are known by a formula, at any size, without a reference.
class ClosedFormCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    lattice_.add_to(app, 1290);
    app.add_option("--variant", variant_, "Who finds the pairs; see catena list").capture_default_str();
    app.footer(
        "The same chain as an input of any command: the scene serpentine. Exit code 1 for a wrong answer.");
  }

  int run() override {
    const LatticeBox& box = lattice_.box;
    const Request request = lattice_.request();
    const auto variant = blaming(variant_, [&] { return StrategyRegistry::instance().make(variant_); });
    const Chain chain = open_input(box.scene()).animation->frame(0);
    Collisions found;
    blaming(variant_, [&] {
      variant->prepare(request);
      variant->build(chain);
      variant->find(chain, request, found);
    });
    const std::string wrong = fault(box, found, !lattice_.counts_only);
    const Timings t = variant->timings();
    if (lattice_.json) {
      const nlohmann::ordered_json line{{"input", box.scene()},
                                        {"n", chain.size()},
                                        {"variant", variant_},
                                        {"pairs", found.pair_count},
                                        {"closed_form", box.pairs()},
                                        {"ties", box.ties()},
                                        {"fault", wrong},
                                        {"build_ms", t.build_ms},
                                        {"find_ms", t.find_ms}};
      fmt::print("{}\n", json_line(line));
    } else {
      fmt::print(
          "{}: {}; closed form {}, {} of them exact ties\n{}: {}, {}; build {:.3f} ms, find {:.3f} ms\n",
          box.scene(), counted(chain.size(), "sphere"), counted(box.pairs(), "pair"), box.ties(), variant_,
          counted(found.pair_count, "pair"), wrong.empty() ? "right" : "WRONG: " + wrong, t.build_ms,
          t.find_ms);
    }
    return wrong.empty() ? 0 : 1;
  }

 private:
  LatticeOptions lattice_;
  std::string variant_ = "Hybrid";
};

const RegisterCommand<ClosedFormCommand> registered{
    "closed-form", "A chain full of exact ties, whose pairs a formula knows, at any size"};

}  // namespace
}  // namespace catena::bench
