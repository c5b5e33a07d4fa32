#include "catena/bench/regret/regret.h"

#include <algorithm>

#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// What auto took beside the quickest single variant, each a line of `catena regret --json`.
nlohmann::ordered_json regret(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  if (std::ranges::find(profile.variants, "auto", &VariantInfo::name) == profile.variants.end()) return rows;
  const auto others = bench::regret_variants(profile.variants);
  const bench::RegretEffort effort{.seconds = profile.section_seconds / 8,
                                   .rounds = 2 * profile.section_rounds,
                                   .seed = profile.stopping.seed};
  for (const bench::WorkloadSpec& spec : profile.regret_inputs)
    attempt("auto", [&] {
      const bench::Regret found = bench::regret(spec, others, effort);
      if (found.left_out.empty()) rows.push_back(bench::to_json(found));
    });
  return rows;
}

const RegisterSection registered{"regret", regret};

}  // namespace
}  // namespace catena::reports
