#include <cmath>

#include "catena/bench/tube/errors_line.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// What a chain makes of every tube that is known exactly, over its spacing.
nlohmann::ordered_json tube_errors(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  if (profile.tube_spacings.empty()) return rows;
  for (const bench::Tube& tube : bench::tubes_named({})) {
    const auto all = bench::approaches(tube);
    for (const double spacing : profile.tube_spacings) {
      const auto n = static_cast<std::uint32_t>(std::ceil(tube.length / spacing)) + !tube.closed;
      rows.push_back(bench::to_json(bench::errors_of(tube, all, n, 0)));
    }
  }
  return rows;
}

const RegisterSection registered{"tube_errors", tube_errors};

}  // namespace
}  // namespace catena::reports
