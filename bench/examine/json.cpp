#include "catena/bench/examine/json.h"

#include "catena/core/commands/report_text.h"

namespace catena::bench {

nlohmann::ordered_json to_json(const std::string& input, const std::string& arithmetic,
                               const reference::Answer& exact, const Examination& e) {
  nlohmann::ordered_json line{{"input", input},
                              {"n", exact.count.size()},
                              {"arithmetic", arithmetic},
                              {"exact_pairs", exact.pair_count},
                              {"parents", e.all.parents},
                              {"failing", e.all.failing},
                              {"worst_shortfall", finite_or_word(e.all.worst_shortfall)},
                              {"missing", e.missing},
                              {"lost_by_tree", e.lost_by_tree},
                              {"invented", e.invented}};
  auto& levels = line["levels"] = nlohmann::ordered_json::array();
  for (const LevelExamined& level : e.levels)
    levels.push_back({{"level", level.level},
                      {"parents", level.parents},
                      {"failing", level.failing},
                      {"worst_shortfall", finite_or_word(level.worst_shortfall)}});
  return line;
}

}  // namespace catena::bench
