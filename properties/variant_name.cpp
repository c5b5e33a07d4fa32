#include "catena/properties/variant_name.h"

#include <algorithm>

namespace catena::properties {
namespace {

/// One strategy of the name, "aGPU2@host" or "aGPU2@host(subtree=6)", with the settings it takes; true if
/// any.
bool set(std::string& strategy, const std::vector<Setting>& settings) {
  auto spec = StrategySpec::parse(strategy);
  const StrategyInfo* const registered = StrategyRegistry::instance().find_strategy(spec.name);
  if (registered == nullptr) return false;  // a mutant's base, made by a test alone
  const auto& declared = registered->parameters;
  bool any = false;
  for (const Setting& setting : settings) {
    const bool known = std::ranges::any_of(declared, [&](const auto& p) { return p.name == setting.key; });
    if (!known || ("," + spec.parameters).find("," + setting.key + "=") != std::string::npos) continue;
    if (!spec.parameters.empty()) spec.parameters += ',';
    spec.parameters += setting.key + "=" + setting.value;
    any = true;
  }
  if (any) strategy = spec.name + "(" + spec.parameters + ")";
  return any;
}

}  // namespace

std::optional<std::string> with_settings(const std::string& variant, const std::vector<Setting>& settings) {
  const auto slash = variant.rfind('/');
  const std::string arithmetic = slash == std::string::npos ? "" : variant.substr(slash);
  std::string build = variant.substr(0, slash), find;
  const auto plus = build.find('+');
  bool any = false;
  if (plus != std::string::npos) {
    find = build.substr(plus + 1);
    build.resize(plus);
    any = set(find, settings);
    find.insert(0, 1, '+');
  }
  any |= set(build, settings);
  if (!any) return std::nullopt;
  return build + find + arithmetic;
}

std::vector<Subject> in_small_blocks(const std::vector<Subject>& subjects) {
  std::vector<Subject> small;
  for (const Subject& subject : subjects)
    if (auto name = with_settings(subject.info.name, {{"subtree", "6"}, {"block", "4"}})) {
      Subject copy{subject.info, [name = *name] { return StrategyRegistry::instance().make(name); }};
      copy.info.name = *name;
      small.push_back(std::move(copy));
    }
  return small;
}

}  // namespace catena::properties
