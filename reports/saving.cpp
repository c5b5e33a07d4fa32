#include "catena/reports/saving.h"

#include "catena/bench/timing/sampling.h"

namespace catena::reports {

nlohmann::ordered_json saving(const std::string& input, const std::string& what, const std::string& reason,
                              bool identical, const std::function<double()>& with,
                              const std::function<double()>& without, const Profile& profile) {
  with(), without();
  const auto ms = bench::interleave({with, without}, 2 * profile.section_rounds, profile.section_seconds / 4,
                                    profile.stopping.seed);
  return {{"input", input},   {"what", what},        {"reason", reason},
          {"with_ms", ms[0]}, {"without_ms", ms[1]}, {"identical", identical}};
}

}  // namespace catena::reports
