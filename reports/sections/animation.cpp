#include <fmt/format.h>

#include <algorithm>

#include "catena/bench/timing/sampling.h"
#include "catena/core/input/input.h"
#include "catena/core/periodic/periodic.h"
#include "catena/reports/faults.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

std::uint32_t moved_spheres(const Chain& before, const Chain& after) {
  std::uint32_t moved = 0;
  for (std::uint32_t i = 0; i < after.size(); ++i) moved += before[i] != after[i];
  return moved;
}

/// Frame by frame: update and find of every exact variant that takes the chain, variants in random order at
/// each frame.
nlohmann::ordered_json animation(const Profile& profile) {
  if (profile.animation_input.input.empty()) return {};
  const bench::WorkloadSpec& spec = profile.animation_input;
  const Input input = open_input(spec.input, spec.options);
  const Chain first = input.animation->frame(0);
  std::vector<std::unique_ptr<Variant>> variants;
  std::vector<Periodic*> in_boxes;  // the same, where a box repeats space
  auto rows = nlohmann::ordered_json::array();
  Collisions found;
  for (const auto& info : exact_variants(profile)) {
    if (info.all_pairs) continue;
    attempt(info.name, [&] {
      auto variant = StrategyRegistry::instance().make(info.name);
      Periodic* const periodic = put_into_boxes(variant, input.boxes);
      variant->build(first);
      variant->find(first, {}, found);
      variants.push_back(std::move(variant));
      in_boxes.push_back(periodic);
      rows.push_back({{"input", bench::label_of(spec)},
                      {"variant", info.name},
                      {"frames", nlohmann::ordered_json::array()}});
    });
  }
  Chain before = first;
  for (std::uint32_t f = 0; f < input.animation->frames(); f += profile.animation_step) {
    const Chain chain = input.animation->frame(f);
    const std::uint32_t moved = moved_spheres(before, chain);
    std::vector<std::function<double()>> runs;
    for (std::size_t k = 0; k < variants.size(); ++k)
      runs.emplace_back([&, k] {
        blaming(rows[k]["variant"], [&] {
          go_to_frame(in_boxes[k], input.boxes, f);
          variants[k]->update(chain);
          variants[k]->find(chain, {}, found);
        });
        const Timings t = variants[k]->timings();
        rows[k]["frames"].push_back({{"frame", f},
                                     {"pairs", found.pair_count},
                                     {"update_ms", t.build_ms},
                                     {"find_ms", t.find_ms},
                                     {"moved", moved}});
        return t.find_ms;
      });
    bench::interleave(runs, 1, 0, profile.stopping.seed + f);
    before = chain;
  }
  return rows;
}

const RegisterSection registered{"animation", animation};

}  // namespace
}  // namespace catena::reports
