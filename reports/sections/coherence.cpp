#include "catena/bench/timing/sampling.h"
#include "catena/core/input/input.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/strategy/timings.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// A moved frame: a variant made anew that builds, against update() of the one that stands.
nlohmann::ordered_json coherence(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& spec : profile.coherent_inputs) {
    const Input input = open_input(spec.input, spec.options);
    const std::uint32_t middle = input.animation->frames() / 2;
    const std::uint32_t first = middle > 0 ? middle - 1 : 0;
    const Chain before = input.animation->frame(first), after = input.animation->frame(middle);
    for (const auto& info : exact_variants(profile)) {
      if (info.all_pairs) continue;
      attempt(info.name, [&] {
        const auto in_box_of = [&](std::uint32_t frame) {
          auto made = StrategyRegistry::instance().make(info.name);
          go_to_frame(put_into_boxes(made, input.boxes), input.boxes, frame);
          return made;
        };
        auto standing = StrategyRegistry::instance().make(info.name);
        Periodic* const periodic = put_into_boxes(standing, input.boxes);
        go_to_frame(periodic, input.boxes, first);
        standing->build(before);
        const auto ms =
            bench::interleave({[&] {
                                 auto anew = in_box_of(middle);
                                 const Stopwatch watch;
                                 anew->build(after);
                                 return watch.ms();
                               },
                               [&] {
                                 go_to_frame(periodic, input.boxes, first);
                                 standing->update(before);
                                 go_to_frame(periodic, input.boxes, middle);
                                 const Stopwatch watch;
                                 standing->update(after);
                                 return watch.ms();
                               }},
                              profile.section_rounds, profile.section_seconds / 5, profile.stopping.seed);
        rows.push_back({{"input", bench::label_of(spec)},
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
