#include <algorithm>
#include <nlohmann/json.hpp>

#include "catena/bench/motion/report.h"
#include "catena/core/strategy/timings.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// The stiff rope: aCPU2+CPU2 in each arithmetic finds its contacts, as in `catena motion`. What the time
/// does not suffice for is left out, the last stiffness first to go.
nlohmann::ordered_json motion(const Profile& profile) {
  constexpr auto exact = "aCPU2+CPU2";
  auto rows = nlohmann::ordered_json::array();
  if (profile.motion_steps.empty()) return rows;
  const double reference_step = std::ranges::min(profile.motion_steps) / 4;
  const Stopwatch watch;
  const auto motion_of = [](double stiffness, double step, double offset, const char* variant) {
    return bench::MotionCase{stiffness, step, offset, variant, 80, 31, 60};
  };
  for (const double stiffness : profile.motion_stiffnesses) {
    if (watch.ms() > 1000 * profile.motion_seconds) break;
    const auto fine = bench::measure_motion(motion_of(stiffness, reference_step, 0, exact));
    for (const double step : profile.motion_steps)
      for (const double offset : profile.motion_offsets) {
        if (watch.ms() > 1000 * profile.motion_seconds) break;
        std::vector<bench::MotionCase> cases;
        for (const char* variant : {exact, "aCPU2+CPU2/literal", "aCPU2+CPU2/double"})
          cases.push_back(motion_of(stiffness, step, offset, variant));
        for (const auto& row : bench::measure_motions(cases, fine, reference_step, 3, profile.motion_starts))
          rows.push_back(bench::to_json(row));
      }
  }
  return rows;
}

const RegisterSection registered{"motion", motion};

}  // namespace
}  // namespace catena::reports
