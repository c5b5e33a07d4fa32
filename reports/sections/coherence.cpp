#include "catena/bench/timing/sampling.h"
#include "catena/core/input/input.h"
#include "catena/core/strategy/timings.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// A moved frame: a variant made anew that builds, against update() of the one that stands.
nlohmann::ordered_json coherence(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& spec : profile.coherent_inputs) {
    const Input input = open_input(spec);
    const std::uint32_t middle = input.animation->frames() / 2;
    const Chain before = input.animation->frame(middle > 0 ? middle - 1 : 0),
                after = input.animation->frame(middle);
    for (const auto& info : exact_variants(profile)) {
      if (info.all_pairs) continue;
      attempt(info.name, [&] {
        const auto standing = StrategyRegistry::instance().make(info.name);
        standing->build(before);
        const auto ms =
            bench::interleave({[&] {
                                 auto anew = StrategyRegistry::instance().make(info.name);
                                 const Stopwatch watch;
                                 anew->build(after);
                                 return watch.ms();
                               },
                               [&] {
                                 standing->update(before);
                                 const Stopwatch watch;
                                 standing->update(after);
                                 return watch.ms();
                               }},
                              profile.section_rounds, profile.section_seconds / 5, profile.stopping.seed);
        rows.push_back({{"input", bench::label_of({spec})},
                        {"variant", info.name},
                        {"rebuild_ms", ms[0]},
                        {"update_ms", ms[1]}});
      });
    }
  }
  return rows;
}

const RegisterSection registered{"coherence", coherence};

}  // namespace
}  // namespace catena::reports
