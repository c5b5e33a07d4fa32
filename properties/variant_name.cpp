#include "catena/properties/variant_name.h"

#include <algorithm>

namespace catena::properties {
namespace {

template <class List, class Key>
bool has_key(const List& list, Key key, const std::string& wanted) {
  return std::ranges::find(list, wanted, key) != list.end();
}

}  // namespace

std::optional<std::string> with_settings(const std::string& variant, const std::vector<Setting>& settings) {
  VariantName name = VariantName::parse(variant);
  bool any = false;
  for (StageName& stage : name.stages) {
    const StrategyInfo* const registered = StrategyRegistry::instance().find_strategy(stage.strategy);
    if (registered == nullptr) continue;  // a mutant's base, made by a test alone
    for (const Setting& setting : settings) {
      const bool known = has_key(registered->parameters, &ParameterInfo::name, setting.key);
      if (!known || has_key(stage.settings, &Setting::key, setting.key)) continue;
      stage.settings.push_back(setting);
      any = true;
    }
  }
  return any ? std::optional(name.text()) : std::nullopt;
}

std::vector<Subject> in_small_blocks(const std::vector<Subject>& subjects) {
  std::vector<Subject> small;
  const auto add = [&](const Subject& subject, const std::vector<Setting>& settings) {
    if (const auto name = with_settings(subject.info.name, settings)) small.push_back(Subject::named(*name));
  };
  for (const Subject& subject : subjects) {
    add(subject,
        {{"subtree", "6"}, {"block", "4"}, {"crowd", "0"}, {"frames", "always"}, {"parts", "3"}, {"group", "4"}});
    // On a device short chains are left to the grid.
    if (subject.info.on_device())
      add(subject, {{"least", "0"}, {"cells", "0"}, {"survey", "0"}});
  }
  return small;
}

}  // namespace catena::properties
