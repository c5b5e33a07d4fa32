#include <cmath>

#include "catena/bench/tube/tube.h"
#include "catena/bench/work_precision/json.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// Error against run time on a tube that is known exactly, at the origin and where rounded arithmetic shows.
nlohmann::ordered_json work_precision(const Profile& profile) {
  nlohmann::ordered_json out;
  if (profile.tubes.empty()) return out;
  std::vector<std::string> names;
  for (const auto& variant : profile.variants) names.push_back(variant.name);
  for (const bench::Tube& tube : bench::tubes_named(profile.tubes)) {
    std::vector<std::uint32_t> sizes;
    for (const double spacing : profile.tube_spacings)
      sizes.push_back(static_cast<std::uint32_t>(std::ceil(tube.length / spacing)));
    for (const double offset : {0.0, 1e7})
      bench::add_to_json(out, bench::work_precision(tube, sizes, names, profile.section_rounds, offset,
                                                    {profile.tube_tolerance}));
  }
  return out;
}

const RegisterSection registered{"work_precision", work_precision};

}  // namespace
}  // namespace catena::reports
