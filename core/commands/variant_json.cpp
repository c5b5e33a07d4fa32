#include "catena/core/commands/variant_json.h"

namespace catena {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const StageName& stage, const Place& place) {
  Json settings = Json::object();
  for (const Setting& s : stage.settings) settings[s.key] = s.value;
  return {{"text", stage.text()},
          {"strategy", stage.strategy},
          {"algorithm", stage.algorithm()},
          {"on_host", stage.is_host_twin()},
          {"settings", std::move(settings)},
          {"place", place.on_device() ? "device" : "host"}};
}

}  // namespace

Json to_json(const VariantInfo& info) {
  Json stages = Json::array();
  for (std::size_t k = 0; k < info.parts.stages.size(); ++k)
    stages.push_back(to_json(info.parts.stages[k], info.places[k]));
  Json out{{"stages", std::move(stages)},  {"arithmetic", info.arithmetic}, {"exact", info.exact},
           {"has_tree", info.has_tree},    {"all_pairs", info.all_pairs},   {"peer", info.peer},
           {"on_device", info.on_device()}};
  if (info.hidden) out["hidden"] = true;
  return out;
}

}  // namespace catena
