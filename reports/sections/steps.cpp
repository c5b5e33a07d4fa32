#include "catena/bench/timing/workload.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// How often the searches that count their steps took each, on the first chain of each input.
nlohmann::ordered_json steps(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& spec : profile.inputs) {
    if (spec.all_frames) continue;
    const auto work = bench::workload(spec);
    const Chain& chain = work->chains.front();
    for (const auto& info : exact_variants(profile)) {
      if (info.on_device() || info.all_pairs) continue;
      attempt(info.name, [&] {
        const auto variant = StrategyRegistry::instance().make(info.name);
        if (variant->work().empty()) return;
        Collisions found;
        variant->build(chain);
        variant->find(chain, {.want = Request::Want::counts}, found);
        auto taken = nlohmann::ordered_json::array();
        for (const WorkDone& done : variant->work())
          taken.push_back({{"step", done.step}, {"times", done.times}});
        rows.push_back({{"input", work->label},
                        {"variant", info.name},
                        {"pairs", found.pair_count},
                        {"steps", std::move(taken)}});
      });
    }
  }
  return rows;
}

const RegisterSection registered{"steps", steps};

}  // namespace
}  // namespace catena::reports
