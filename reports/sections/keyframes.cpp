#include <fmt/format.h>

#include "catena/bench/timing/workload.h"
#include "catena/core/input/input.h"
#include "catena/reference/reference.h"
#include "catena/reports/section.h"

namespace catena::reports {
namespace {

/// The exact pairs of every keyframe of the paper's two paths.
nlohmann::ordered_json keyframes(const Profile& profile) {
  auto rows = nlohmann::ordered_json::array();
  for (const char* path : {"path1", "path2"})
    for (const std::uint32_t n : profile.keyframe_sizes) {
      const auto spec = fmt::format("{}:n={}", path, n);
      const Input input = open_input(spec);
      auto pairs = nlohmann::ordered_json::array();
      for (std::uint32_t f = 0; f < input.animation->frames(); ++f)
        pairs.push_back(
            reference::find(input.animation->frame(f), {.want = Request::Want::counts}).pair_count);
      rows.push_back({{"input", bench::label_of({spec})}, {"pairs", std::move(pairs)}});
    }
  return rows;
}

const RegisterSection registered{"keyframes", keyframes};

}  // namespace
}  // namespace catena::reports
