#include "catena/core/scenes/scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/scenes/setup.h"

namespace catena {

SceneRegistry& SceneRegistry::instance() {
  static SceneRegistry registry;
  return registry;
}

void SceneRegistry::add(SceneInfo info, Make make) {
  std::vector<ParameterInfo> parameters = SceneSetup::declared();
  for (ParameterInfo& own : info.parameters) {
    const auto common = std::ranges::find(parameters, own.name, &ParameterInfo::name);
    if (common != parameters.end())
      *common = std::move(own);
    else
      parameters.push_back(std::move(own));
  }
  info.parameters = std::move(parameters);
  const std::string name = info.name;
  if (!entries_.emplace(name, Entry{std::move(info), std::move(make)}).second)
    throw std::logic_error("the scene " + name + " is registered twice");
}

std::vector<SceneInfo> SceneRegistry::scenes() const {
  std::vector<SceneInfo> infos;
  for (const auto& [name, entry] : entries_) infos.push_back(entry.info);
  return infos;
}

bool SceneRegistry::contains(std::string_view name) const { return entries_.contains(name); }

std::unique_ptr<Animation> SceneRegistry::open(std::string_view spec) const {
  const auto colon = spec.find(':');
  const std::string_view name = spec.substr(0, colon);
  const auto found = entries_.find(name);
  if (found == entries_.end()) {
    std::vector<std::string> known;  // not views::keys, which clang 14 cannot compile
    for (const auto& entry : entries_) known.push_back(entry.first);
    throw InputError(fmt::format("no scene is named '{}'; there are: {}{}", name, fmt::join(known, ", "),
                                 did_you_mean(name, known)));
  }
  const std::string_view values = colon == std::string_view::npos ? "" : spec.substr(colon + 1);
  std::vector<ParameterInfo> parameters = found->second.info.parameters;
  parameters.push_back(
      {"frame", "", "this frame alone"});  // for open_scene, which takes it out; said with the others
  const Parameters written(fmt::format("scene {}", name), parameters, values);
  if (written.given("frame")) throw InputError(fmt::format("{}: a frame alone is no scene", spec));
  return found->second.make(written);
}

}  // namespace catena
