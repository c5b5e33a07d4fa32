#include <fmt/format.h>

#include "catena/bench/examine/json.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/reference/reference.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// Where the paper's parents do not enclose, by n and by distance from the origin.
nlohmann::ordered_json examine(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const char* scene : {"rod", "path1", "yarn"})
    for (const auto& setting : profile.examine_settings) {
      const std::string spec = fmt::format("{}:{}", scene, setting);
      const Input input = open_input(spec);
      const Chain chain = input.animation->frame(input.animation->frames() / 2);
      const auto exact = reference::find(chain);
      for (const char* arithmetic : {"literal", "double"}) {
        try {
          rows.push_back(bench::to_json(spec, arithmetic, exact, bench::examine(arithmetic, chain, exact)));
        } catch (const PairLimitExceeded&) {  // the arithmetic invents a flood: nothing to examine
        }
      }
    }
  return rows;
}

const RegisterSection registered{"examine", examine};

}  // namespace
}  // namespace catena::reports
