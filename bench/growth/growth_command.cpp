#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "catena/bench/growth/growth.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

/// `catena growth`: how the pairs of nodes that a search compares grow with the chain.
class GrowthCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("SCENE", scenes_, "Scenes without n").capture_default_str();
    app.add_option("--n", most_, "Spheres of the longest chain; chains are from 1,000 on, in half decades")
        .whole_number(32'000)
        .capture_default_str();
    app.add_option("--variant", variants_, "Whose work is counted; repeatable")
        .allow_extra_args(false)
        .capture_default_str();
    app.add_flag("--json", json_, "One JSON object a line for each scene and variant");
    app.footer("Agarwal and others prove O(n^(4/3)) for Necklace, where spheres do not overlap too deeply.");
  }

  int run() override {
    if (most_ >= std::uint64_t{1} << 31) throw InputError("--n must be below 2^31");
    // What is misspelt, or counts nothing, is said before work on the first.
    for (const std::string& scene : scenes_) open_input(sized(scene, 1000));
    std::vector<VariantInfo> variants;
    for (const std::string& name : variants_) {
      variants.push_back(StrategyRegistry::instance().describe(name));
      measure_growth(scenes_.front(), variants.back(), 1000);
    }
    bool begun = json_;
    for (const std::string& scene : scenes_)
      for (const VariantInfo& variant : variants) {
        const Growth growth = measure_growth(scene, variant, static_cast<std::uint32_t>(most_));
        if (!std::exchange(begun, true))
          fmt::print("{:<12} {:<24} {:>9} {:>8} {:>17} {}\n", "scene", "variant", "exponent", "", "95 %",
                     "n^(4/3)");
        json_ ? fmt::print("{}\n", json_line(to_json(growth))) : print(growth);
      }
    return 0;
  }

 private:
  static void print(const Growth& growth) {
    const Growth::Law law = growth.law();
    fmt::print("{:<12} {:<24} {:>9.4f} {:>8} {:>17} {}\n", growth.scene, growth.variant, law.exponent, "",
               fmt::format("{:.4f} to {:.4f}", law.low, law.high),
               growth.within_four_thirds() ? "within" : "ABOVE");
    const Growth::Law plain = growth.plain_power();
    fmt::print("  without a surface's share n^(-1/3): {:.4f}, {:.4f} to {:.4f}\n", plain.exponent, plain.low,
               plain.high);
    for (const auto& p : growth.points)
      fmt::print("  {:>10} {:>14} {:>9.1f} a sphere\n", p.n, p.node_pairs,
                 static_cast<double>(p.node_pairs) / p.n);
  }

  std::vector<std::string> scenes_{"yarn", "path1", "lattice"},
      variants_{"Necklace", "Necklace(balls=nested)", "aCPU2+Dual", "aCPU2+CPU2"};
  std::uint64_t most_ = 100'000;
  bool json_ = false;
};

const RegisterCommand<GrowthCommand> registered{
    "growth", "How the pairs of nodes that a search compares grow with the chain, counted"};

}  // namespace
}  // namespace catena::bench
