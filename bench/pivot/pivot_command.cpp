#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "catena/bench/pivot/at_once.h"
#include "catena/bench/pivot/end_to_end.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/output_names.h"
#include "catena/core/error.h"
#include "catena/core/output_file.h"
#include "catena/core/readers/chain_format.h"
#include "catena/core/readers/text_lines.h"
#include "catena/reference/reference.h"

namespace catena::bench {
namespace {

/// `catena pivot`: a self-avoiding walk under the pivot algorithm, judged by the exact reference at its end.
class PivotCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("--n", points_, "Points of the walk").whole_number(2).capture_default_str();
    app.add_option("--moves", moves_, "Attempts that are measured").whole_number(64).capture_default_str();
    app.add_option("--warm-up", warm_up_,
                   "Attempts before, from a straight walk on (default: a fifth of the moves, or 20 a point)")
        .whole_number();
    app.add_option("--seed", seed_, "Of the random pivots").whole_number().capture_default_str();
    app.add_option("--rotations", rotations_,
                   "lattice: the 48 symmetries of the cubic lattice; any: every rotation, of spheres that "
                   "touch their "
                   "neighbours, where the spheres as written in binary32 decide")
        .one_of({"lattice", "any"})
        .capture_default_str();
    const auto exponent = app.add_flag(
        "--exponent", exponent_, "Walks of N, N/2, ... N/32 points, and the exponent nu from all of them");
    app.add_flag("--at-once", at_once_,
                 "Then the cost of k pivots at once, k = 1 to N - 1, beside that of a rebuild with the "
                 "fastest variant")
        .excludes(exponent);
    app.add_option("--out", out_, "Write the last walk to this .chain file, spheres that touch where it does")
        .type_name("FILE");
    app.add_flag("--json", json_, "One JSON object a line for each length");
    app.footer(
        "Exit code 1 when the exact reference finds that the walk meets itself, or a rebuild answers "
        "otherwise.");
  }

  int run() override {
    const bool any = rotations_ == "any";
    if (!any && points_ > 1u << 30) throw InputError("--n must be at most 2^30");
    if (any && points_ > RotatedChain<>::most_spheres)
      throw InputError("--n must be at most 2^22 with --rotations any");
    // Walks of two points have one length, which has no error.
    if (exponent_ && points_ < 96)
      throw InputError("--n must be at least 96 with --exponent: walks down to N/32 points");
    if (at_once_ && any)
      throw InputError("--at-once goes with --rotations lattice: it makes moves together, exactly");
    std::optional<OutputFile>
        out;  // from the start: hours of walking are not lost to a name that cannot be written
    if (!out_.empty()) check_out(), out.emplace(out_);
    return any ? walk<RotatedChain<>>(out) : walk<PivotWalk>(out);
  }

 private:
  void check_out() const {
    require_apart({}, {out_});
    const std::filesystem::path out = OutputFile::target(out_);
    if (!OutputFile::written_through(out) && lower_case(out.extension().string()) != ".chain")
      throw InputError(
          fmt::format("{}: a walk is written as .chain; catena export makes other files of that", out_));
  }

  /// Of spheres that must not collide.
  static Chain judged(const PivotWalk& walk) { return walk.chain(std::nextafter(0.5f, 0.0f)); }
  static Chain judged(const RotatedChain<>& chain) { return chain.chain(); }
  /// Of spheres that touch where the walk does.
  static Chain shown(const PivotWalk& walk) { return walk.chain(0.5f); }
  static Chain shown(const RotatedChain<>& chain) { return chain.chain(); }

  template <class Walk>
  int walk(std::optional<OutputFile>& out) {
    std::vector<EndToEnd> lengths;
    Random random(seed_);
    for (int halvings = exponent_ ? 5 : 0; halvings >= 0; --halvings) {
      Walk walk(static_cast<std::uint32_t>(points_ >> halvings));
      lengths.push_back(measure_end_to_end(walk, moves_, random, warm_up_));
      const bool avoids_itself =
          reference::find(judged(walk), {.want = Request::Want::counts}).pair_count == 0;
      print(lengths.back(), avoids_itself);
      if (!avoids_itself) return 1;
      if (halvings == 0 && out) {
        std::ostringstream text;
        write_chain(text, shown(walk));
        out->write(text.str());
        out->close();
      }
      if (at_once_ && !together(walk, random)) return 1;
    }
    if (exponent_) print(fit_exponent(lengths));
    return 0;
  }

  bool together(RotatedChain<>&, Random&) const { return true; }
  bool together(PivotWalk& walk, Random& random) const {
    constexpr double seconds = 0.3;
    bool agree = true;
    for (const AtOnce& seen : measure_at_once(walk, seconds, random)) {
      print(seen);
      agree &= seen.agree;
    }
    return agree;
  }

  void print(const EndToEnd& seen, bool avoids_itself) const {
    if (json_) {
      auto line = to_json(seen);
      line["avoids_itself"] = avoids_itself;
      fmt::print("{}\n", json_line(line));
      return;
    }
    fmt::print(
        "{} points: {} attempts, {:.4f} accepted, {:.3f} us each, {:.1f} bytes a point; R^2 = {:.6g} +- "
        "{:.2g}; {}\n",
        seen.points, seen.attempts, seen.acceptance, seen.us_per_attempt, seen.bytes_per_point,
        seen.mean_square, seen.error,
        avoids_itself ? "self-avoiding by the exact reference" : "MEETS ITSELF");
  }

  void print(const AtOnce& seen) const {
    if (json_) {
      fmt::print("{}\n", json_line(to_json(seen)));
      return;
    }
    fmt::print("{} at once: {:.4g} us, {:.4f} accepted; {} anew {:.4g} us, {:.3g} times as much{}\n",
               seen.pivots, seen.us_per_attempt, seen.acceptance, AtOnce::rebuilt, seen.rebuild_us,
               seen.times(), seen.agree ? "" : "; they DIFFER");
  }

  void print(const Exponent& exponent) const {
    if (json_) {
      const nlohmann::ordered_json line{{"nu", exponent.nu},
                                        {"half_width", exponent.half_width},
                                        {"published", Exponent::published},
                                        {"agrees", exponent.agrees()}};
      fmt::print("{}\n", json_line(line));
      return;
    }
    fmt::print("nu = {:.6f} +- {:.6f}; published {:.8f} +- {:.8f}: {}\n", exponent.nu, exponent.half_width,
               Exponent::published, Exponent::published_error, exponent.agrees() ? "agrees" : "DIFFERS");
  }

  std::uint64_t points_ = 4096, moves_ = 100'000, seed_ = 1;
  bool exponent_ = false, at_once_ = false, json_ = false;
  std::optional<std::uint64_t> warm_up_;
  std::string out_, rotations_ = "lattice";
};

const RegisterCommand<PivotCommand> registered{
    "pivot", "A self-avoiding walk under the pivot algorithm: acceptance, distance of its ends, exponent"};

}  // namespace
}  // namespace catena::bench
