#include "catena/reference/verify_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "catena/core/commands/json_line.h"
#include "catena/core/commands/report_text.h"
#include "catena/core/counted.h"
#include "catena/core/one_line.h"

namespace catena::reference {
namespace {

constexpr auto table_line = "  {:<{}}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}  {}\n";

std::string verdict_of(const Verification& v) {
  if (!v.reason.empty()) return name_of(v.verdict) + ": " + v.reason;
  if (!v.certificate) return name_of(v.verdict);
  return fmt::format("{}, certified: {} node pairs discarded, {} pairs tested", name_of(v.verdict),
                     v.certificate->discarded, v.certificate->tested);
}

VerifyReport::Figures figures_of(const Verification& v) {
  const auto figure = [](bool known, std::uint64_t value) { return known ? fmt::format("{}", value) : "-"; };
  return {figure(v.ran, v.comparison.pairs), figure(v.ran && v.by_pairs, v.comparison.missing),
          figure(v.ran && v.by_pairs, v.comparison.invented),
          figure(v.enclosure.bounds > 0, v.enclosure.violations)};
}

/// Few names as they are, many by their number and the first.
std::string named(const std::vector<std::string>& variants, std::size_t all) {
  if (variants.size() <= 2) return fmt::format("{}", fmt::join(variants, ", "));
  if (variants.size() == all) return fmt::format("all {}", all);
  return fmt::format("{} and {} more", variants.front(), variants.size() - 1);
}

}  // namespace

std::string VerifyReport::label(const VerifyRow& row) {
  const std::filesystem::path path(row.input);
  std::string name = path.has_parent_path() ? path.filename().string() : row.input;
  if (named_.emplace(name, row.input).first->second != row.input) name = row.input;
  name = one_line(name);
  return row.frame == 0 ? name : fmt::format("{} #{}", name, row.frame);
}

void VerifyReport::row(const VerifyRow& row) {
  ++verdicts_[row.result.verdict];
  inputs_.insert(row.input);
  if (json_) {
    json_row(row);
  } else {
    if (row.result.verdict == Verdict::wrong)
      fmt::print("{} on {}: {}\n", row.variant.name, label(row), verdict_of(row.result));
    gather(row);
  }
  std::fflush(stdout);
}

void VerifyReport::gather(const VerifyRow& row) {
  const std::string& name = row.variant.name;
  if (row.result.verdict == Verdict::unavailable) {
    absent_[row.result.reason].insert(name);
    return;
  }
  if (row.variant.exact && row.result.verdict == Verdict::wrong) faulty_.insert(name);
  if (row.variant.exact && row.result.verdict == Verdict::exact) right_.insert(name);
  if (row.variant.exact && row.result.verdict == Verdict::undecided) undecided_.insert(name);
  variants_[row.variant.arithmetic].insert(name);
  auto& lines = lines_[row.variant.arithmetic];
  Line line{label(row), figures_of(row.result), verdict_of(row.result), {}};
  auto same = std::ranges::find_if(lines, [&](const Line& other) {
    return other.input == line.input && other.figures == line.figures && other.verdict == line.verdict;
  });
  if (same == lines.end()) same = lines.insert(lines.end(), std::move(line));
  same->variants.push_back(name);
}

void VerifyReport::print_headline() const {
  Names known, right;
  std::ranges::set_difference(right_, faulty_, std::inserter(known, known.end()));
  std::ranges::set_difference(known, undecided_, std::inserter(right, right.end()));
  if (!undecided_.empty()) fmt::print("\nNot decided on every input: {}\n", fmt::join(undecided_, ", "));
  if (!faulty_.empty())
    fmt::print("\nNOT every exact variant is exact. Wrong: {}\n", fmt::join(faulty_, ", "));
  else if (!right.empty())
    fmt::print("Every {}exact variant is exact, on {}: {}\n", undecided_.empty() ? "" : "other ",
               counted(inputs_.size(), "input"), fmt::join(right, ", "));
}

void VerifyReport::print_arithmetic(const std::string& arithmetic, const std::vector<Line>& lines) const {
  const std::size_t all = variants_.at(arithmetic).size();
  std::vector<std::string> inputs, names;
  for (const Line& line : lines) inputs.push_back(line.input), names.push_back(named(line.variants, all));
  const std::size_t input_width = widest(inputs, 5), name_width = widest(names, 8);
  fmt::print("\n{}: {}\n", arithmetic, fmt::join(variants_.at(arithmetic), ", "));
  fmt::print(table_line, "input", input_width, "variants", name_width, "pairs", "missing", "invented",
             "unenclosed", "verdict");
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto& [pairs, missing, invented, unenclosed] = lines[k].figures;
    fmt::print(table_line, inputs[k], input_width, names[k], name_width, pairs, missing, invented, unenclosed,
               lines[k].verdict);
  }
}

void VerifyReport::json_row(const VerifyRow& row) {
  const Verification& v = row.result;
  nlohmann::ordered_json line{{"input", row.input},
                              {"frame", row.frame},
                              {"n", row.spheres},
                              {"variant", row.variant.name},
                              {"exact_pairs", row.exact_pairs}};
  if (v.ran) {
    const Comparison& c = v.comparison;
    line["pairs"] = c.pairs;
    if (v.by_pairs) {
      line["missing"] = c.missing;
      line["invented"] = c.invented;
      line["neighbours"] = c.neighbours;
      line["repeated"] = c.repeated;
      line["malformed"] = c.malformed;
      line["inconsistent_counts"] = c.inconsistent_counts;
      line["worst_margin"] = finite_or_word(c.worst_margin);
    }
    line["wrong_counts"] = c.wrong_counts;
    line["bounds"] = v.enclosure.bounds;
    line["unenclosed"] = v.enclosure.violations;
    line["worst_shortfall"] = finite_or_word(v.enclosure.worst_shortfall);
    line["depth"] = v.shape.depth;
  }
  if (v.certificate)
    line["certificate"] = {{"holds", v.certificate->holds()},
                           {"discarded", v.certificate->discarded},
                           {"tested", v.certificate->tested},
                           {"excluded", v.certificate->excluded}};
  line["verdict"] = v.verdict == Verdict::wrong ? "wrong" : name_of(v.verdict);
  if (!v.reason.empty()) line["reason"] = v.reason;
  fmt::print("{}\n", json_line(line));
}

void VerifyReport::finish() const {
  if (json_) return;
  print_headline();
  for (const auto& [arithmetic, lines] : lines_) print_arithmetic(arithmetic, lines);
  if (!absent_.empty()) fmt::print("\n");
  for (const auto& [reason, variants] : absent_)
    fmt::print("not available here, {}: {}\n", reason, fmt::join(variants, ", "));
  std::vector<std::string> parts;
  for (const auto& [verdict, number] : verdicts_)
    parts.push_back(fmt::format("{} {}", number, name_of(verdict)));
  fmt::print("\n{}\n", parts.empty() ? "nothing to verify" : fmt::format("{}", fmt::join(parts, ", ")));
}

}  // namespace catena::reference
