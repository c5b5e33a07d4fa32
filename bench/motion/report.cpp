#include "catena/bench/motion/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "catena/bench/stability/cell.h"
#include "catena/bench/timing/spread.h"
#include "catena/core/commands/report_text.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {
namespace {

bool holds(const MotionRow& row) { return row.result.outcome == MotionOutcome::holds; }

/// The same motion, but for who finds the contacts.
bool same_motion(const MotionCase& a, const MotionCase& b) {
  return a.stiffness == b.stiffness && a.step == b.step && a.offset == b.offset && a.n == b.n;
}

std::string of_one_stiffness(const std::vector<const MotionRow*>& rows) {
  std::vector<std::string> held, failed;
  for (const MotionRow* row : rows)
    if (holds(*row))
      held.push_back(fmt::format("{:g}", row->motion.step));
    else
      failed.push_back(
          fmt::format("{} at step {:g} (time {:.3g})",
                      row->result.outcome == MotionOutcome::slipped ? "slips through itself" : "diverges",
                      row->motion.step, *row->result.failed_at));
  std::string text = fmt::format("stiffness {:g}: ", rows.front()->motion.stiffness);
  if (!held.empty()) text += fmt::format("holds at step {}", fmt::join(held, ", "));
  if (!held.empty() && !failed.empty()) text += "; ";
  return text + fmt::format("{}", fmt::join(failed, ", "));
}

std::string in_words(const FailingShare& share) {
  return fmt::format("{:.0f} % [{:.0f}, {:.0f}]", 100 * share.value, 100 * share.low, 100 * share.high);
}

/// Where more of this row's starts fail than of an exact variant's, beyond both intervals.
std::string fault_of_arithmetic(const MotionRow& row, const std::vector<MotionRow>& rows) {
  if (row.motion.exact() || row.starts.empty()) return "";
  const FailingShare own = failing_share(row.starts);
  for (const MotionRow& exact : rows) {
    if (!exact.motion.exact() || !same_motion(exact.motion, row.motion) || exact.starts.empty()) continue;
    const FailingShare its = failing_share(exact.starts);
    if (own.low <= its.high) continue;
    return fmt::format("stiffness {:g}, step {:g} (fails from {} of {} starts, {} from {})",
                       row.motion.stiffness, row.motion.step, in_words(own), row.starts.size(),
                       exact.motion.variant, in_words(its));
  }
  return "";
}

}  // namespace

FailingShare failing_share(const std::vector<MotionStart>& starts) {
  if (starts.empty()) return {};
  constexpr double z = 1.959963984540054;
  const auto n = static_cast<double>(starts.size());
  const double share =
      static_cast<double>(std::ranges::count_if(
          starts, [](const MotionStart& start) { return start.outcome != MotionOutcome::holds; })) /
      n;
  const double centre = share + z * z / (2 * n), widened = 1 + z * z / n,
               reach = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {share, std::max(0.0, (centre - reach) / widened), std::min(1.0, (centre + reach) / widened)};
}

nlohmann::ordered_json to_json(const MotionRow& row) {
  const auto& [motion, result, reference_step, against_fine, starts] = row;
  nlohmann::ordered_json line{
      {"stiffness", motion.stiffness},
      {"step", motion.step},
      {"offset", motion.offset},
      {"n", motion.n},
      {"frames", motion.frames},
      {"duration", motion.duration},
      {"variant", motion.variant},
      {"arithmetic", StrategyRegistry::instance().describe(motion.variant).arithmetic},
      {"outcome", name_of(result.outcome)},
      {"failed_at", nullptr},
      {"energy_drift", finite_or_word(result.energy_drift)},
      {"deepest_penetration", finite_or_word(result.deepest_penetration)},
      {"greatest_strain", finite_or_word(result.greatest_strain)},
      {"searches", result.searches},
      {"contacts", result.contacts},
      {"missed_by_variant", result.missed},
      {"invented_by_variant", result.invented},
      {"reference_step", reference_step},
      {"reference_contacts", against_fine.contacts},
      {"missed_against_fine_step", against_fine.missed}};
  if (result.failed_at) line["failed_at"] = *result.failed_at;
  const Spread time = Spread::of(result.ms);
  line["ms_median"] = time.median;
  line["ms_lower"] = time.lower;
  line["ms_upper"] = time.upper;
  line["ms"] = result.ms;
  line["find_ms"] = result.find_ms;
  line["starts"] = nlohmann::ordered_json::array();
  for (const MotionStart& start : starts) {
    line["starts"].push_back({{"seed", start.seed},
                              {"outcome", name_of(start.outcome)},
                              {"failed_at", nullptr},
                              {"energy_drift", finite_or_word(start.energy_drift)},
                              {"contacts", start.contacts},
                              {"missed", start.missed},
                              {"invented", start.invented}});
    if (start.failed_at) line["starts"].back()["failed_at"] = *start.failed_at;
  }
  return line;
}

void MotionTable::print(const MotionRow& row) {
  constexpr auto line = "{:>9} {:>8} {:>7}  {:<26} {:<18} {:>15} {:>9} {:>11} {:>13} {:>17} {:>10} {:>17}\n";
  if (!begun_) {
    fmt::print(line, "stiffness", "step", "offset", "variant", "outcome", "starts failing", "drift",
               "penetration", "missed, fine", "missed, invented", "median ms", "quartiles");
    begun_ = true;
  }
  const MotionResult& r = row.result;
  const Spread time = Spread::of(r.ms);
  fmt::print(line, fmt::format("{:g}", row.motion.stiffness), fmt::format("{:g}", row.motion.step),
             fmt::format("{:g}", row.motion.offset), row.motion.variant,
             r.failed_at ? fmt::format("{} at {:.3g}", name_of(r.outcome), *r.failed_at) : name_of(r.outcome),
             in_words(failing_share(row.starts)), fmt::format("{:.2e}", r.energy_drift),
             fmt::format("{:.3f}", r.deepest_penetration),
             fmt::format("{} of {}", row.against_fine.missed, row.against_fine.contacts),
             fmt::format("{}, {} of {}", r.missed, r.invented, r.contacts),
             fmt::format("{:.1f}", time.median), fmt::format("{:.1f} .. {:.1f}", time.lower, time.upper));
}

std::vector<std::string> motion_verdicts(const std::vector<MotionRow>& rows) {
  std::vector<std::string> lines;
  std::vector<const MotionRow*> left;
  for (const MotionRow& row : rows) left.push_back(&row);
  while (!left.empty()) {
    const MotionCase& head = left.front()->motion;
    std::vector<std::string> stiffnesses, faults;
    std::vector<const MotionRow*> own, others;
    for (const MotionRow* row : left)
      (row->motion.variant == head.variant && row->motion.offset == head.offset ? own : others)
          .push_back(row);
    std::ranges::stable_sort(own, {}, [](const MotionRow* row) { return row->motion.stiffness; });
    for (auto at = own.begin(); at != own.end();) {
      const auto end = std::find_if(at, own.end(), [&](const MotionRow* row) {
        return row->motion.stiffness != (*at)->motion.stiffness;
      });
      stiffnesses.push_back(of_one_stiffness({at, end}));
      at = end;
    }
    for (const MotionRow* row : own)
      if (std::string fault = fault_of_arithmetic(*row, rows); !fault.empty())
        faults.push_back(std::move(fault));
    lines.push_back(fmt::format(
        "{}, {:g} radii from the origin: {}.{}", head.variant, head.offset, fmt::join(stiffnesses, "; "),
        faults.empty() ? "" : fmt::format(" Its arithmetic is at fault at {}.", fmt::join(faults, "; "))));
    left = std::move(others);
  }
  return lines;
}

}  // namespace catena::bench
