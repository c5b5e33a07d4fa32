#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catena/bench/motion/motion.h"
#include "catena/bench/motion/report.h"
#include "catena/bench/stability/cell.h"
#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/progress.h"
#include "catena/core/counted.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/motion/knot.h"
#include "catena/core/notice.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"

namespace catena::bench {
namespace {

constexpr auto footer = R"(
A rope of N spheres, radius 1, spacing 1, with a loose overhand knot is pulled at both ends with a force of 1; lengths
are in radii, and in one unit of time the pull moves a rope of length 1, from rest, by 1/2. In every row:
  drift        greatest error of the balance of energy (kinetic + elastic + contact - initial - work of the ends +
               dissipated by drag) over the initial energy and the greatest work
  penetration  the deepest of any two spheres over the radius, found or not; 2: their centres meet
  missed, fine contacts in the frames of the same motion at --reference-step, exact and at the origin, that this one
               has not there, nor two spheres along the rope from there
  missed, invented  by the variant, against the exact reference on the same stored chains, over all searches
Near a knife edge one motion says nothing: each is begun from --starts perturbed starts (other small velocities), and
"starts failing" is the share of them that slip or diverge with its 95 % interval. An arithmetic is called at fault
only where its interval lies above that of an exact variant.
An outcome "slipped" means that the knot is another one, or none: the rope passed through itself.
--json writes the same as stiffness, step, offset, n, frames, duration, variant, arithmetic, outcome, failed_at (time
or null), energy_drift, deepest_penetration, greatest_strain (of an edge), searches, contacts (exact, over all
searches), missed_by_variant, invented_by_variant, reference_step, reference_contacts, missed_against_fine_step,
ms_median, ms_lower, ms_upper (quartiles), ms (the whole motion, each repetition), find_ms (of it in the variant, least),
starts (of each start seed, outcome, failed_at, energy_drift, contacts, missed, invented).
Exit code 1: an exact variant missed or invented a contact.)";

/// `catena motion`: error against run time of a stiff motion, by stiffness, step, arithmetic and offset.
class MotionCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    const auto list = [&](const char* name, std::vector<double>& values, const char* meaning) {
      return app.add_option(name, values, meaning).allow_extra_args(false).capture_default_str();
    };
    list("--stiffness", stiffness_, "Tension at a strain of 1, over the pull; repeatable")
        .type_name("S")
        .range(1.0, 1e12);
    list("--step", steps_, "Time step at most; repeatable").type_name("H").range(1e-4, 1e3);
    list("--offset", offsets_, "Of the stored chain along every axis, in radii; repeatable")
        .type_name("D")
        .range(-1e30, 1e30);
    app.add_option("--variant", variants_, "Finds the contacts; repeatable")
        .type_name("V")
        .allow_extra_args(false)
        .capture_default_str();
    app.add_option("--n", n_, "Spheres of the rope").capture_default_str().range(motion::least_knot, 100'000u);
    app.add_option("--frames", frames_, "Frames, compared with the fine motion")
        .capture_default_str()
        .range(2u, 100'000u);
    app.add_option("--duration", duration_, "Time of the last frame").capture_default_str().range(1e-3, 1e6);
    app.add_option("--reference-step", reference_step_,
                   "Step of the fine motion (default: 1/8 of the least step)")
        .type_name("H")
        .range(1e-5, 1e3);
    app.add_option("--repetitions", repetitions_, "Timed rounds, each over all variants in random order")
        .capture_default_str()
        .range(1, 100000);
    app.add_option("--starts", starts_, "Perturbed starts of each motion")
        .capture_default_str()
        .range(1, 100000);
    app.add_option("--seconds", seconds_,
                   "Begins no further motion after this time, and says how many are left")
        .range(0.0, 1e9);
    app.add_flag("--json", json_, "One JSON object a line for each motion");
    app.footer(footer);
  }

  int run() override {
    require_release_build();
    for (const auto& name : variants_) StrategyRegistry::instance().make(name);  // says now what is not there
    if (reference_step_ == 0) reference_step_ = *std::ranges::min_element(steps_) / 8;
    const Stopwatch watch;
    const std::size_t groups = stiffness_.size() * steps_.size() * offsets_.size();
    Progress progress(groups + stiffness_.size());
    MotionTable table;
    std::vector<MotionRow> rows;
    std::size_t left_out = 0;
    for (const double stiffness : stiffness_) {
      if (watch.ms() > 1000 * seconds_) {
        left_out += steps_.size() * offsets_.size() * variants_.size();
        continue;
      }
      progress.step(fmt::format("fine motion, stiffness {:g}", stiffness));
      const MotionResult fine = measure_motion(motion(stiffness, reference_step_, 0, exact_variant));
      for (const double offset : offsets_)
        for (const double step : steps_) {
          progress.step(fmt::format("stiffness {:g}, offset {:g}, step {:g}", stiffness, offset, step));
          if (watch.ms() > 1000 * seconds_) {
            left_out += variants_.size();
            continue;
          }
          const std::vector<MotionRow> group = measure(stiffness, step, offset, fine);
          progress.clear();
          for (const MotionRow& row : group)
            json_ ? fmt::print("{}\n", json_line(to_json(row))) : table.print(row);
          std::fflush(stdout);
          rows.insert(rows.end(), group.begin(), group.end());
        }
    }
    if (!json_)
      for (const auto& line : motion_verdicts(rows)) fmt::print("\n{}\n", line);
    if (left_out > 0)
      notice("catena motion",
             fmt::format("{} left out: --seconds {:g} were over", counted(left_out, "motion"), seconds_));
    if (rows.empty()) throw InputError("nothing was measured: --seconds were over before the first motion");
    const bool defect = std::ranges::any_of(rows, [](const MotionRow& row) {
      return row.motion.exact() && row.result.missed + row.result.invented > 0;
    });
    return defect ? 1 : 0;
  }

 private:
  static constexpr auto exact_variant = "aCPU2+CPU2";

  MotionCase motion(double stiffness, double step, double offset, const std::string& variant) const {
    return {stiffness, step, offset, variant, n_, frames_, duration_};
  }

  std::vector<MotionRow> measure(double stiffness, double step, double offset,
                                 const MotionResult& fine) const {
    std::vector<MotionCase> motions;
    for (const auto& variant : variants_) motions.push_back(motion(stiffness, step, offset, variant));
    return measure_motions(motions, fine, reference_step_, repetitions_, starts_);
  }

  std::vector<double> stiffness_{1e4, 1e6}, steps_{1, 0.5}, offsets_{0, 1e7};
  std::vector<std::string> variants_{"aCPU2+CPU2", "aCPU2+CPU2/literal", "aCPU2+CPU2/double"};
  std::uint32_t n_ = 120, frames_ = 51;
  double duration_ = 100, reference_step_ = 0, seconds_ = 1e9;
  std::size_t repetitions_ = 3, starts_ = 32;
  bool json_ = false;
};

const RegisterCommand<MotionCommand> registered{
    "motion", "Pull a rope into a knot: by stiffness, step and arithmetic, what fails, and at what run time"};

}  // namespace
}  // namespace catena::bench
