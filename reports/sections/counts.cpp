#include "catena/bench/counts/count_work.h"
#include "catena/bench/timing/cases.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

constexpr std::uint32_t most_all_pairs =
    3000;  ///< above, what an O(n^2) variant does is known: n (n - 1) / 2

/// The work of every variant that is timed and can be counted, on the first chain of each input.
nlohmann::ordered_json counts(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& c : bench::cases(profile.inputs, profile.variants, most_all_pairs)) {
    if (c.stage != bench::Stage::find || c.facts.in_box)
      continue;  // the evidence is of the images, not of the chain
    const auto work = bench::workload(c.spec);
    attempt(c.variant.name, [&] {  // the timed row of a variant that refuses this chain says why
      if (const auto counted = bench::count_work(c.variant, work->chains.front()))
        rows.push_back({{"input", work->label},
                        {"variant", c.variant.name},
                        {"pair_tests", counted->pair_tests},
                        {"node_visits", counted->node_visits},
                        {"bytes", counted->bytes}});
    });
  }
  return rows;
}

const RegisterSection registered{"counts", counts};

}  // namespace
}  // namespace catena::reports
