#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catena/bench/tube/contacts.h"
#include "catena/bench/tube/errors_line.h"
#include "catena/bench/tube/tube.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/error.h"

namespace catena::bench {
namespace {

/// `catena errors`: what a chain makes of a tube, and what storing it adds; what an algorithm adds after that
/// is the business of `catena stability`.
class ErrorsCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("TUBE", names_, "Tubes that are known exactly; none: all of them");
    app.add_option("--n", sizes_, "Spheres of the chain; repeatable (default: spacings from 1 to 1e-3 radii)")
        .type_name("N")
        .allow_extra_args(false)
        .range(std::uint32_t{8}, std::uint32_t{100'000'000});
    app.add_option("--offset", offset_, "Moves the stored chain along every axis, in radii").type_name("D");
    app.add_flag("--json", json_, "One JSON object a line for each tube and n");
  }

  int run() override {
    if (!std::isfinite(offset_) || std::abs(offset_) > 1e30)
      throw InputError("--offset must be a number from -1e30 to 1e30");
    bool broken = false;
    for (const Tube& tube : tubes_named(names_)) {
      const auto all = approaches(tube);
      if (!json_) head(tube, all);
      for (const std::uint32_t n : sizes_of(tube)) {
        const TubeErrors errors = errors_of(tube, all, n, offset_);
        json_ ? fmt::print("{}\n", json_line(to_json(errors))) : print_row(errors.tube, errors.storage);
        broken |= errors.tube.missed_by_covering > 0;
      }
    }
    return broken ? 1 : 0;
  }

 private:
  std::vector<std::uint32_t> sizes_of(const Tube& tube) const {
    if (!sizes_.empty()) return sizes_;
    std::vector<std::uint32_t> sizes;
    for (const double spacing : {1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001})
      sizes.push_back(static_cast<std::uint32_t>(std::ceil(tube.length / spacing)) + !tube.closed);
    return sizes;
  }

  static void head(const Tube& tube, const std::vector<Approach>& all) {
    const auto touching = contacts(tube, all);
    double deepest = 0;
    for (const Approach& a : touching) deepest = std::max(deepest, a.depth(tube.radius));
    fmt::print("{}: {:.6g} radii long, {} contact regions, the deepest {:.6g}; {} near misses\n", tube.name,
               tube.length / tube.radius, touching.size(), deepest, all.size() - touching.size());
    fmt::print("{:>9} {:>9} {:>10} {:>10} {:>10} {:>7} {:>10} {:>8} {:>9} {:>6} {:>10}\n", "n", "spacing",
               "gap", "volume", "depth", "missed", "covering", "invented", "pairs", "flips", "least");
    fmt::print("{:>9} {:>9} {:>10} {:>10} {:>10} {:>7} {:>10} {:>8} {:>9} {:>6} {:>10}\n", "", "", "",
               "deficit", "error", "", "depth err.", "", "stored", "", "margin");
  }

  static void print_row(const TubeError& e, const std::optional<StorageError>& s) {
    fmt::print("{:>9} {:>9.4g} {:>10.3e} {:>10.3e} {:>10.3e} {:>7} {:>10.3e} {:>8} {:>9} {:>6} {:>10}\n", e.n,
               e.spacing, e.gap, e.volume_deficit, e.depth_error, e.missed, e.covering_depth_error,
               e.invented, s ? fmt::format("{}", s->pairs) : "-", s ? fmt::format("{}", s->flips) : "-",
               s ? fmt::format("{:.2e}", s->least_margin) : "-");
  }

  std::vector<std::string> names_;
  std::vector<std::uint32_t> sizes_;
  double offset_ = 0;
  bool json_ = false;
};

const RegisterCommand<ErrorsCommand> registered{
    "errors", "What a chain of spheres makes of a tube that is known exactly, and what storing it adds"};

}  // namespace
}  // namespace catena::bench
