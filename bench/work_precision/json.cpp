#include "catena/bench/work_precision/json.h"

#include <algorithm>
#include <cstddef>

#include "catena/core/commands/report_text.h"

namespace catena::bench {

void add_to_json(nlohmann::ordered_json& out, const WorkPrecision& result) {
  for (const char* key : {"left_out", "points"})
    if (!out.contains(key)) out[key] = nlohmann::ordered_json::array();
  auto& left_out = out["left_out"];
  for (const nlohmann::ordered_json why : result.left_out)
    if (std::find(left_out.begin(), left_out.end(), why) == left_out.end()) left_out.push_back(why);
  auto& list = out["points"];
  const std::size_t before = list.size();
  for (const Point& p : result.points) {
    list.push_back({{"tube", p.tube},
                    {"offset", p.offset},
                    {"n", p.n},
                    {"variant", p.variant},
                    {"arithmetic", p.arithmetic},
                    {"tube_error", p.tube_error},
                    {"stored_error", p.stored_error},
                    {"answer_error", p.answer_error},
                    {"exact_pairs", p.exact_pairs},
                    {"missing", p.missing},
                    {"invented", p.invented},
                    {"worst_margin", finite_or_word(p.worst_margin)},
                    {"depth_error", finite_or_word(p.depth_error)},
                    {"repetitions", p.repetitions},
                    {"least_ms", p.time.least},
                    {"lower_quartile_ms", p.time.lower},
                    {"median_ms", p.time.median},
                    {"upper_quartile_ms", p.time.upper},
                    {"front", !p.dominated_by.has_value()}});
    if (p.tolerance) list.back()["tolerance"] = *p.tolerance;
    if (p.dominated_by) list.back()["dominated_by"] = before + *p.dominated_by;
  }
}

}  // namespace catena::bench
