#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "catena/bench/margins/margins.h"
#include "catena/bench/timing/chain_hash.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/scenes/scene.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

std::string summary_of(const std::string& scene) {
  for (const SceneInfo& info : SceneRegistry::instance().scenes())
    if (info.name == scene) return info.summary;
  return "";
}

/// What a search in the box adds to the chain.
std::uint32_t images_of(const Chain& chain, const PeriodicBox& box) {
  Periodic periodic(StrategyRegistry::instance().make("CPU1"), box);
  periodic.build(chain);
  return periodic.images();
}

nlohmann::ordered_json scenes(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& spec : profile.inputs) {
    const auto work = bench::workload(spec);
    const auto most =
        std::ranges::max_element(work->exact, {}, &reference::Answer::pair_count) - work->exact.begin();
    const Chain& chain = work->chains[static_cast<std::size_t>(most)];
    const auto& exact = work->exact[static_cast<std::size_t>(most)];
    const PeriodicBox* const box = work->box_of(chain);
    const double n = std::max(1.0, static_cast<double>(chain.size()));
    nlohmann::ordered_json row{{"input", work->label},
                               {"spec", spec.input},
                               {"scene", scene_name(spec.input)},
                               {"n", chain.size()},
                               {"frame", spec.all_frames ? nlohmann::ordered_json("all")
                                                         : nlohmann::ordered_json(work->first_frame)},
                               {"frames", work->frames},
                               {"summary", summary_of(scene_name(spec.input))},
                               {"hash", fmt::format("{:016x}", bench::chain_hash(chain))},
                               {"pairs", exact.pair_count},
                               {"max_count", exact.count.empty() ? 0 : std::ranges::max(exact.count)},
                               {"density", static_cast<double>(exact.pair_count) / n}};
    if (const double margin = bench::margins_of(chain, 0, box).least; std::isfinite(margin))
      row["smallest_margin"] = margin;
    if (const std::string options = in_command(spec.options); !options.empty()) row["options"] = options;
    if (box != nullptr) {
      row["box"] = written(*box);
      row["images"] = images_of(chain, *box);
      row["summary"] = fmt::format(
          "space repeats in the box {}: build puts the spheres into it and makes {} images at its faces, "
          "find decides exactly what lies across them; both are timed",
          written(*box), row["images"].get<std::uint32_t>());
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

const RegisterSection registered{"scenes", scenes};

}  // namespace
}  // namespace catena::reports
