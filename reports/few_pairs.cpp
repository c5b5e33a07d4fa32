#include "catena/reports/few_pairs.h"

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "catena/core/notice.h"

namespace catena::reports {

Profile with_few_pairs(Profile profile, const std::function<void(const bench::WorkloadSpec&)>& make) {
  std::set<std::string> crowded;
  for (const bench::WorkloadSpec& spec : profile.inputs) {
    if (crowded.contains(spec.input)) continue;
    try {
      make(spec);
    } catch (const bench::TooManyPairs& why) {
      notice("catena report", fmt::format("{}; it is left out", why.what()));
      crowded.insert(spec.input);
    }
  }
  const auto leave_out = [&](std::vector<bench::WorkloadSpec>& specs) {
    std::erase_if(specs, [&](const bench::WorkloadSpec& spec) { return crowded.contains(spec.input); });
  };
  for (auto* specs : {&profile.inputs, &profile.shown, &profile.wants_inputs, &profile.coherent_inputs,
                      &profile.regret_inputs})
    leave_out(*specs);
  std::erase_if(profile.planned_inputs, [&](const std::string& input) { return crowded.contains(input); });
  if (crowded.contains(profile.animation_input.input)) profile.animation_input = {};
  return profile;
}

}  // namespace catena::reports
