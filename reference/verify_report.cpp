#include "catena/reference/verify_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "catena/core/commands/report_text.h"

namespace catena::reference {
namespace {

constexpr auto table_line = "{:<{}}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}  {}\n";

/// Files by their name alone, so that a long path does not push the figures off the screen.
std::string label(const std::string& input) {
  const std::filesystem::path path(input);
  return path.has_parent_path() ? path.filename().string() : input;
}

}  // namespace

VerifyReport::VerifyReport(bool json, const std::vector<std::string>& inputs,
                           const std::vector<std::string>& variants)
    : json_(json), input_width_(0), variant_width_(widest(variants, 7)) {
  std::vector<std::string> labels;
  for (const auto& input : inputs) labels.push_back(label(input));
  input_width_ = widest(labels, 5);
  if (!json_)
    fmt::print(table_line, "input", input_width_, "variant", variant_width_, "pairs", "missing", "invented",
               "unenclosed", "verdict");
}

void VerifyReport::row(const VerifyRow& row) {
  ++verdicts_[row.result.verdict];
  json_ ? json_row(row) : table_row(row);
  std::fflush(stdout);
}

void VerifyReport::table_row(const VerifyRow& row) const {
  const Verification& v = row.result;
  const auto figure = [](bool known, std::uint64_t value) { return known ? fmt::format("{}", value) : "-"; };
  const std::string input =
      row.frame == 0 ? label(row.input) : fmt::format("{} #{}", label(row.input), row.frame);
  const std::string why = !v.reason.empty() ? ": " + v.reason
                          : v.certificate
                              ? fmt::format(", certified: {} node pairs discarded, {} pairs tested",
                                            v.certificate->discarded, v.certificate->tested)
                              : "";
  fmt::print(table_line, input, input_width_, row.variant, variant_width_, figure(v.ran, v.comparison.pairs),
             figure(v.ran && v.by_pairs, v.comparison.missing),
             figure(v.ran && v.by_pairs, v.comparison.invented),
             figure(v.enclosure.bounds > 0, v.enclosure.violations), name_of(v.verdict) + why);
}

void VerifyReport::json_row(const VerifyRow& row) const {
  const Verification& v = row.result;
  nlohmann::ordered_json line{{"input", row.input},
                              {"frame", row.frame},
                              {"n", row.spheres},
                              {"variant", row.variant},
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
  fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void VerifyReport::finish() const {
  if (json_) return;
  std::vector<std::string> parts;
  for (const auto& [verdict, number] : verdicts_)
    parts.push_back(fmt::format("{} {}", number, name_of(verdict)));
  fmt::print("\n{}\n", parts.empty() ? "nothing to verify" : fmt::format("{}", fmt::join(parts, ", ")));
}

}  // namespace catena::reference
