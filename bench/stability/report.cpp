#include "catena/bench/stability/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <tuple>

#include "catena/core/commands/json_line.h"
#include "catena/core/commands/report_text.h"
#include "catena/core/one_line.h"
#include "catena/core/percent.h"

namespace catena::bench {
namespace {

constexpr std::size_t column = 34;

/// "wrong -12 +3 by 1.2e-07": pairs missing, invented, and the largest margin of a wrong decision.
std::string in_short(const Cell& cell) {
  const auto& c = cell.found.comparison;
  std::string text = name_of(cell.outcome);
  if (cell.outcome == Outcome::not_finite) text = fmt::format("{} nodes NaN", cell.not_finite_nodes);
  if (cell.outcome == Outcome::unenclosed) text += " " + percent(cell.found.enclosure.share());
  if (cell.outcome != Outcome::wrong && cell.outcome != Outcome::not_finite) return text;
  if (!cell.found.by_pairs) return text + fmt::format(" {} counts", c.wrong_counts);
  if (c.right()) return text;
  return text + fmt::format(" -{} +{} by {:.0e}", c.missing, c.invented, c.worst_margin);
}

std::string pairs_of(const Cell& cell) { return cell.answered ? fmt::format("{}", cell.exact_pairs) : "-"; }

/// A few names, or how many.
std::string in_short(const std::set<std::string>& names, const char* what) {
  return names.size() <= 4 ? fmt::format("{}", fmt::join(names, ", "))
                           : fmt::format("{} {}", names.size(), what);
}

bool worse(const Cell& a, const Cell& b) {
  const auto key = [](const Cell& c) {
    return std::tuple(c.defect, c.outcome, c.found.comparison.missing + c.found.comparison.invented,
                      c.found.enclosure.violations);
  };
  return key(a) < key(b);
}

}  // namespace

StabilityReport::StabilityReport(Form form, const std::vector<std::string>& scenes,
                                 const std::vector<std::string>& variants,
                                 std::vector<std::string> arithmetics)
    : form_(form),
      scene_width_(widest(scenes, 5)),
      variant_width_(widest(variants, 7)),
      arithmetics_(std::move(arithmetics)) {
  std::ranges::sort(arithmetics_, std::ranges::greater{});  // robust, literal, double
  arithmetics_.erase(std::unique(arithmetics_.begin(), arithmetics_.end()), arithmetics_.end());
  if (form_ == Form::table) {
    fmt::print("{:<{}}  {:>8}", "scene", scene_width_, "pairs");
    for (const auto& arithmetic : arithmetics_) fmt::print("  {:<{}}", arithmetic, column);
    fmt::print("\n");
  }
  if (form_ == Form::cells)
    fmt::print("{:<{}}  {:<{}}  {:>8}  {}\n", "scene", scene_width_, "variant", variant_width_, "pairs",
               "outcome");
}

void StabilityReport::scene(const std::vector<Cell>& cells) {
  for (const Cell& cell : cells) {
    ++outcomes_[cell.arithmetic][cell.outcome];
    if (cell.defect) defects_.push_back(cell);
    if (cell.outcome >= Outcome::unavailable && cell.outcome <= Outcome::undecided) {
      LeftOut& left_out = left_out_[cell.found.reason];
      left_out.variants.insert(cell.variant);
      left_out.scenes.insert(cell.scene);
    }
    if (form_ == Form::json) fmt::print("{}\n", json_line(to_json(cell)));
    if (form_ == Form::cells) cell_line(cell);
  }
  if (form_ == Form::table && !cells.empty()) table_line(cells);
  std::fflush(stdout);
}

void StabilityReport::table_line(const std::vector<Cell>& cells) const {
  fmt::print("{:<{}}  {:>8}", one_line(cells.front().scene), scene_width_, pairs_of(cells.front()));
  for (const auto& arithmetic : arithmetics_) {
    const Cell* worst = nullptr;
    std::size_t alike = 0, all = 0;
    for (const Cell& cell : cells) {
      if (cell.arithmetic != arithmetic || cell.outcome == Outcome::unavailable) continue;
      if (cell.outcome == Outcome::refused && worst != nullptr) continue;
      ++all;
      if (worst == nullptr || worse(*worst, cell)) worst = &cell;
    }
    for (const Cell& cell : cells)
      alike += worst != nullptr && cell.arithmetic == arithmetic && cell.outcome == worst->outcome;
    std::string text = worst == nullptr ? "-" : in_short(*worst);
    if (alike < all) text += fmt::format(" ({}/{})", alike, all);
    fmt::print("  {:<{}}", text, column);
  }
  fmt::print("\n");
}

void StabilityReport::cell_line(const Cell& cell) const {
  const std::string why = cell.found.reason.empty() ? "" : ": " + one_line(cell.found.reason);
  fmt::print("{:<{}}  {:<{}}  {:>8}  {}{}{}\n", one_line(cell.scene), scene_width_, cell.variant,
             variant_width_, pairs_of(cell), cell.defect ? "DEFECT " : "", in_short(cell), why);
}

void StabilityReport::finish() const {
  if (form_ == Form::json) return;
  if (form_ == Form::table)
    fmt::print(
        "\nThe worst variant of each arithmetic; (k/m): so many of its variants end like this. -missing "
        "+invented by "
        "the largest\nmargin |q - t|/t of a wrong decision; unenclosed: right pairs although so many bounds "
        "do not "
        "enclose.\n");
  for (const auto& [arithmetic, outcomes] : outcomes_) {
    std::vector<std::string> parts;
    for (const auto& [outcome, times] : outcomes)
      parts.push_back(fmt::format("{} {}", times, name_of(outcome)));
    fmt::print("{}: {}\n", arithmetic, fmt::join(parts, ", "));
  }
  for (const auto& [why, which] : left_out_)
    fmt::print("left out: {} on {}: {}\n", in_short(which.variants, "variants"),
               one_line(in_short(which.scenes, "scenes")), one_line(why));
  for (const Cell& cell : defects_)
    fmt::print("DEFECT: {} on {}: {} {}\n", cell.variant, one_line(cell.scene), in_short(cell),
               one_line(cell.found.reason));
}

nlohmann::ordered_json to_json(const Cell& cell) {
  const auto& v = cell.found;
  nlohmann::ordered_json line{{"scene", cell.scene},
                              {"n", cell.spheres},
                              {"variant", cell.variant},
                              {"arithmetic", cell.arithmetic},
                              {"outcome", name_of(cell.outcome)},
                              {"defect", cell.defect}};
  if (cell.answered) line["exact_pairs"] = cell.exact_pairs;
  if (v.ran) {
    if (v.by_pairs) {
      line["missing"] = v.comparison.missing;
      line["invented"] = v.comparison.invented;
      line["worst_margin"] = finite_or_word(v.comparison.worst_margin);
    }
    line["wrong_counts"] = v.comparison.wrong_counts;
    line["bounds"] = v.enclosure.bounds;
    line["unenclosed"] = v.enclosure.violations;
    line["unenclosed_share"] = v.enclosure.share();
    line["worst_shortfall"] = finite_or_word(v.enclosure.worst_shortfall);
    line["not_finite_nodes"] = cell.not_finite_nodes;
  }
  if (!v.reason.empty()) line["reason"] = v.reason;
  return line;
}

}  // namespace catena::bench
