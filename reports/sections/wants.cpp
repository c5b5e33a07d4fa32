#include "catena/bench/timing/sampling.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

using Want = Request::Want;

constexpr std::uint32_t most_all_pairs = 3000;  ///< above, an O(n^2) variant takes the time of all the others

/// What find costs by what is asked for.
nlohmann::ordered_json wants(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& input : profile.wants_inputs) {
    const auto work = bench::workload(input);
    const Chain& chain = work->chains.front();
    std::vector<std::unique_ptr<Variant>> ready;
    std::vector<std::function<double()>> runs;
    Collisions found;
    auto cells = nlohmann::ordered_json::array();
    for (const auto& info : exact_variants(profile)) {
      if (info.all_pairs && chain.size() > most_all_pairs) continue;
      attempt(info.name, [&] {
        auto variant = work->make(info.name);
        variant->build(chain);
        for (const auto& [want, name] :
             {std::pair{Want::pairs, "pairs"}, {Want::counts, "counts"}, {Want::any, "any"}}) {
          variant->find(chain, {.want = want}, found);
          runs.emplace_back([v = variant.get(), &chain, &found, want = want] {
            v->find(chain, {.want = want}, found);
            return v->timings().find_ms;
          });
          cells.push_back({{"input", work->label}, {"variant", info.name}, {"want", name}});
        }
        ready.push_back(std::move(variant));
      });
    }
    const auto ms =
        bench::interleave(runs, profile.section_rounds, profile.section_seconds, profile.stopping.seed);
    for (std::size_t k = 0; k < ms.size(); ++k) {
      cells[k]["ms"] = ms[k];
      rows.push_back(std::move(cells[k]));
    }
  }
  return rows;
}

const RegisterSection registered{"wants", wants};

}  // namespace
}  // namespace catena::reports
