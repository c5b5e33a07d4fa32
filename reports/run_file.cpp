#include "catena/reports/run_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "catena/core/commands/variant_json.h"
#include "catena/core/counted.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/notice.h"
#include "catena/core/output_file.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/timings.h"
#include "catena/reports/faults.h"
#include "catena/reports/few_pairs.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

using Json = nlohmann::ordered_json;

/// Of timing, whatever the sections took: on a busy machine the page is late, but its advice rests on rounds.
constexpr double least_seconds = 60;

std::vector<bench::Case> timed_cases(const Profile& profile) {
  return bench::filtered(bench::cases(profile.inputs, profile.variants, profile.most_all_pairs),
                         profile.filter);
}

/// A second or less is no whole number of them.
std::string limit_in_words(const bench::Stopping& stopping) {
  if (stopping.seconds >= unlimited_seconds) return "";
  return stopping.seconds < 10 ? fmt::format(" for at most {:.3g} s", stopping.seconds)
                               : fmt::format(" for at most {:.0f} s", stopping.seconds);
}

Json stopping_of(const bench::Stopping& s, const bench::Rounds& measured) {
  return {{"interval", "95 % of the median, by order statistics"},
          {"share", s.share},
          {"seconds", s.seconds},
          {"most_samples", s.most_samples},
          {"seed", s.seed},
          {"rounds", measured.rounds},
          {"cases", measured.cases},
          {"narrow", measured.narrow},
          {"not_reached", measured.not_reached}};
}

/// What a section measures; nothing, and a fault, when a variant throws in the middle of it, and nothing
/// where a frame has more pairs than are compared.
Json measured(const Section& section, const Profile& profile) {
  try {
    return section.measure(profile);
  } catch (const VariantThrew& fault) {
    note_fault(fmt::format("{}; the section {} is left out", fault.what(), section.name));
  } catch (const PairLimitExceeded& why) {
    notice("catena report", fmt::format("{}; it is left out", bench::TooManyPairs(section.name, why).what()));
  }
  return {};
}

/// Every name that stands under a key "variant" of `json`, at any depth.
void collect_variants(const Json& json, std::set<std::string>& names) {
  if (json.is_object() && json.contains("variant")) names.insert(json["variant"].get<std::string>());
  for (const Json& inner : json)
    if (inner.is_structured()) collect_variants(inner, names);
}

}  // namespace

Json described_variants(const std::vector<VariantInfo>& timed, const Json& sections) {
  std::set<std::string> names;
  for (const VariantInfo& v : timed) names.insert(v.name);
  collect_variants(sections, names);
  Json variants = Json::object();
  for (const auto& name : names) variants[name] = to_json(StrategyRegistry::instance().describe(name));
  return variants;
}

Json measure_run(const Profile& profile, const std::string& command) {
  Journal none;
  return measure_run(profile, command, none);
}

Json measure_run(const Profile& profile, const std::string& command, Journal& journal) {
  require_release_build();
  const auto facts = environment();
  const auto cases = timed_cases(profile);
  if (cases.empty())
    throw InputError(
        "nothing to measure: no case matches; catena_bench --benchmark_list_tests shows how they are named");

  const Stopwatch watch;
  const Profile of_sections = with_few_pairs(profile);
  Json measured_sections;
  for (const Section& section : sections()) {
    const Stopwatch own_watch;
    Json content = journal.section(section.name, [&] { return measured(section, of_sections); });
    if (content.is_null() || content.empty()) continue;
    measured_sections[section.name] = std::move(content);
    notice("catena report", fmt::format("{} in {:.1f} s", section.name, own_watch.ms() / 1000));
  }

  const double sections_before = journal.section_seconds(), rows_before = journal.row_seconds();
  bench::Stopping stopping = profile.stopping;
  if (profile.whole_seconds > 0)
    stopping.seconds =
        std::min(stopping.seconds,
                 std::max(least_seconds, profile.whole_seconds - sections_before - watch.ms() / 1000));
  notice("catena report",
         fmt::format("timing {}{}", counted(cases.size(), "case"), limit_in_words(stopping)));
  bench::Stopping rest = stopping;
  rest.seconds = std::max(0.0, stopping.seconds - rows_before);
  const Stopwatch timing;
  bench::Rounds timed = bench::measure_in_rounds(
      cases, rest, [&](const Json& row) { journal.keep_row(row, timing.ms() / 1000); }, journal.rows());

  Json run{{"context", std::move(timed.context)}, {"benchmarks", std::move(timed.benchmarks)}};
  for (const auto& [key, value] : facts) run["context"][key] = value;
  Json& own = run["catena"] = {{"schema", 1},
                               {"profile", profile.name},
                               {"command", command},
                               {"seconds", sections_before + rows_before + watch.ms() / 1000}};
  own["stopping"] = stopping_of(stopping, timed);
  own["variants"] = described_variants(profile.variants, measured_sections);
  own.update(measured_sections);
  for (const auto& fault : timed.faults) note_fault(fault);
  return run;
}

void write_run(const Json& run, const std::string& file) {
  write_file(file, run.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n');
}

}  // namespace catena::reports
