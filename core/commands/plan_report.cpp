#include "catena/core/commands/plan_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace catena {
namespace {

using Row = std::array<std::string, 6>;

std::string ms(const std::optional<double>& time) { return time ? fmt::format("{:.3g} ms", *time) : ""; }

Row row_of(const Decision& d) {
  return {d.step, d.left_out ? "left out" : "done", ms(d.estimate_ms), ms(d.actual_ms), d.removed, d.reason};
}

}  // namespace

std::string plan_table(const Plan& plan, const std::string& indent) {
  if (plan.empty()) return indent + "every step is done: there is none to choose\n";
  const Row head{"step", "", "estimate", "actual", "removed", "because"};
  std::vector<Row> rows{head};
  for (const Decision& d : plan) rows.push_back(row_of(d));
  std::array<std::size_t, head.size()> width{};
  for (std::size_t c = 0; c < head.size(); ++c) {
    const bool filled =
        std::any_of(rows.begin() + 1, rows.end(), [c](const Row& r) { return !r[c].empty(); });
    if (filled)
      for (const Row& r : rows) width[c] = std::max(width[c], r[c].size());
  }
  std::string text;
  for (const Row& r : rows) {
    std::string line = indent;
    for (std::size_t c = 0; c < head.size(); ++c)
      if (width[c] > 0) fmt::format_to(std::back_inserter(line), "{:<{}}  ", r[c], width[c]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

nlohmann::ordered_json to_json(const Plan& plan) {
  auto steps = nlohmann::ordered_json::array();
  for (const Decision& d : plan) {
    nlohmann::ordered_json step{{"step", d.step}, {"left_out", d.left_out}, {"reason", d.reason}};
    if (d.estimate_ms) step["estimate_ms"] = *d.estimate_ms;
    if (d.actual_ms) step["actual_ms"] = *d.actual_ms;
    if (!d.removed.empty()) step["removed"] = d.removed;
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace catena
