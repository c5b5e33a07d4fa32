#include "catena/core/strategy/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "catena/core/default_floats.h"
#include "catena/core/error.h"
#include "catena/core/never_destroyed.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/strategy/in_default_floats.h"

namespace catena {
namespace {

/// What a name without an arithmetic means, where the strategy has it.
constexpr const char* usual_arithmetic = "robust";

std::optional<std::string> reason(const StrategyInfo& info) {
  return info.unavailable ? info.unavailable() : std::nullopt;
}

/// "; 'aGPU2@host' runs ...", of a device's algorithm that has such a twin.
std::string twin_of(const StrategyInfo& info) {
  const std::string twin = info.name + std::string(StageName::on_host);
  if (StrategyRegistry::instance().find_strategy(twin) == nullptr) return "";
  return fmt::format("; '{}' runs the same on the host", twin);
}

void require_available(const StrategyInfo& info) {
  if (const auto why = reason(info))
    throw CapacityError(fmt::format("{} is not available here: {}{}", info.name, *why, twin_of(info)));
}

/// The arithmetic that a name means: the one written, the usual one, or the only one of `had`.
std::string arithmetic_meant(const VariantName& name, const std::set<std::string>& had) {
  if (!name.arithmetic.empty()) return name.arithmetic;
  return had.size() == 1 ? *had.begin() : usual_arithmetic;
}

/// The stages' settings, checked against what they declare.
Parameters parameters_of(const StageName& stage, const StrategyInfo& info) {
  return Parameters(stage.strategy, info.parameters, stage.settings_text());
}

/// Which device a stage is to use, by its own parameter where it has one.
Place place_of(const StrategyInfo& info, const Parameters& parameters) {
  const bool chosen =
      info.place.on_device() &&
      std::ranges::find(info.parameters, "device", &ParameterInfo::name) != info.parameters.end();
  return chosen ? Place::device(static_cast<std::uint32_t>(parameters.unsigned_integer("device", 0, 1023)))
                : info.place;
}

/// "; did you mean ...", from these names and, of a device's algorithm where none is built in, its host twin.
template <class Names>
std::string instead_of(const std::string& wanted, const Names& names) {
  const std::string twin = wanted + std::string(StageName::on_host);
  if (std::ranges::find(names, twin) != std::ranges::end(names))
    return fmt::format("; catena is built without devices here, and '{}' runs the same on the host", twin);
  return did_you_mean(wanted, {names.begin(), names.end()});
}

/// One name has one meaning: by which of two of them a search is made, nobody could tell.
template <class Entries>
void require_new(const Entries& entries, const StrategyInfo& info, const ArithmeticInfo& arithmetic) {
  for (const auto& e : entries)
    if (e.info.name == info.name && e.arithmetic.name == arithmetic.name)
      throw std::logic_error(
          fmt::format("the strategy {} in {} arithmetic is registered twice", info.name, arithmetic.name));
}

template <class Entries>
std::set<std::string> arithmetics(const Entries& entries) {
  std::set<std::string> names;
  for (const auto& e : entries) names.insert(e.arithmetic.name);
  return names;
}

}  // namespace

StrategyRegistry& StrategyRegistry::instance() {
  static StrategyRegistry& registry = never_destroyed(StrategyRegistry());
  return registry;
}

void StrategyRegistry::add_construction(const StrategyInfo& info, const ArithmeticInfo& arithmetic,
                                        const TreeType& tree, MakeStage make) {
  require_new(constructions_, info, arithmetic);
  constructions_.push_back({info, arithmetic, tree, std::move(make)});
}

void StrategyRegistry::add_traversal(const StrategyInfo& info, const ArithmeticInfo& arithmetic,
                                     const TreeType& tree, MakeStage make) {
  require_new(traversals_, info, arithmetic);
  traversals_.push_back({info, arithmetic, tree, std::move(make)});
}

void StrategyRegistry::add_variant(const StrategyInfo& info, const ArithmeticInfo& arithmetic,
                                   MakeVariant make, bool hidden) {
  require_new(complete_, info, arithmetic);
  complete_.push_back(
      {info, arithmetic, hidden, std::move(make), Parameters(info.name, info.parameters, "")});
}

VariantInfo StrategyRegistry::info_of(const VariantEntry& entry) const {
  const auto namesakes =
      std::ranges::count(complete_, entry.info.name, [](const auto& e) { return e.info.name; });
  VariantInfo info;
  info.parts.stages = {{entry.info.name}};
  if (entry.arithmetic.name != usual_arithmetic && namesakes > 1)
    info.parts.arithmetic = entry.arithmetic.name;
  info.name = info.parts.text();
  info.places = {entry.info.place};
  info.arithmetic = entry.arithmetic.name;
  info.summary = entry.info.summary;
  info.exact = entry.arithmetic.exact;
  info.all_pairs = entry.info.all_pairs;
  info.has_tree = entry.info.has_tree;
  info.peer = entry.info.peer;
  info.resident = entry.info.resident;
  info.hidden = entry.hidden;
  info.promises = entry.info.promises;
  info.cost = entry.info.cost;
  info.unavailable = reason(entry.info);
  return info;
}

VariantInfo StrategyRegistry::info_of(const StageEntry& construction, const StageEntry& traversal) {
  VariantInfo info;
  info.parts.stages = {{construction.info.name}, {traversal.info.name}};
  if (construction.arithmetic.name != usual_arithmetic) info.parts.arithmetic = construction.arithmetic.name;
  info.name = info.parts.text();
  info.places = {construction.info.place, traversal.info.place};
  info.arithmetic = construction.arithmetic.name;
  info.summary = construction.info.summary + "; " + traversal.info.summary;
  info.exact = construction.arithmetic.exact && traversal.arithmetic.exact;
  info.has_tree = true;
  info.resident = construction.info.place.on_device() && traversal.info.place.on_device();
  info.promises = {construction.info.promises.same_bits, traversal.info.promises.same_order};
  info.unavailable = reason(construction.info);
  if (!info.unavailable) info.unavailable = reason(traversal.info);
  return info;
}

bool StrategyRegistry::combine(const StageEntry& construction, const StageEntry& traversal) {
  return construction.arithmetic.name == traversal.arithmetic.name &&
         construction.tree.type == traversal.tree.type &&
         (construction.tree.movable || construction.info.place == traversal.info.place);
}

std::vector<VariantInfo> StrategyRegistry::variants(bool with_hidden) const {
  std::vector<VariantInfo> list;
  for (const VariantEntry& e : complete_)
    if (with_hidden || !e.hidden) list.push_back(info_of(e));
  for (const StageEntry& c : constructions_)
    for (const StageEntry& t : traversals_)
      if (combine(c, t)) list.push_back(info_of(c, t));
  std::ranges::sort(list, {}, &VariantInfo::name);
  return list;
}

std::vector<std::string> StrategyRegistry::strategy_names() const {
  std::set<std::string> names;
  for (const VariantEntry& e : complete_)
    if (!e.hidden) names.insert(e.info.name);
  for (const auto* stages : {&constructions_, &traversals_})
    for (const StageEntry& e : *stages) names.insert(e.info.name);
  return {names.begin(), names.end()};
}

std::vector<std::string> StrategyRegistry::rivals(std::uint32_t n, const Extent& extent) const {
  std::set<std::pair<double, std::string>> by_risk;
  for (const VariantEntry& e : complete_)
    if (!e.hidden && e.arithmetic.exact && e.info.rival)
      if (const double risk = e.info.rival(n, extent); risk > 0) by_risk.emplace(risk, e.info.name);
  std::vector<std::string> names;
  for (const auto& [risk, name] : by_risk) names.push_back(name);
  return names;
}

const StrategyInfo* StrategyRegistry::find_strategy(std::string_view name) const {
  for (const VariantEntry& e : complete_)
    if (e.info.name == name) return &e.info;
  for (const auto* stages : {&constructions_, &traversals_})
    for (const StageEntry& e : *stages)
      if (e.info.name == name) return &e.info;
  return nullptr;
}

const StrategyInfo& StrategyRegistry::strategy(std::string_view name) const {
  const StrategyInfo* found = find_strategy(name);
  if (found == nullptr)
    throw InputError(fmt::format("there is no strategy '{}'; there are: {}{}", name,
                                 fmt::join(strategy_names(), ", "),
                                 instead_of(std::string(name), strategy_names())));
  return *found;
}

/// `arithmetic`: as written, or empty.
const StrategyRegistry::VariantEntry* StrategyRegistry::resolve_whole(std::string_view wanted,
                                                                      std::string_view arithmetic) const {
  const std::string_view meant = arithmetic.empty() ? usual_arithmetic : arithmetic;
  std::set<std::string> had;
  const VariantEntry* last = nullptr;
  for (const VariantEntry& e : complete_) {
    if (e.info.name != wanted) continue;
    if (e.arithmetic.name == meant) return &e;
    had.insert(e.arithmetic.name), last = &e;
  }
  if (had.size() == 1 && arithmetic.empty()) return last;
  if (!had.empty())
    throw InputError(
        fmt::format("'{}' has no {} arithmetic; it has: {}", wanted, meant, fmt::join(had, ", ")));
  strategy(wanted);  // throws when there is no such strategy at all
  throw InputError(
      fmt::format("'{}' is one stage only; write construction+traversal, as in aCPU2+CPU2", wanted));
}

StrategyRegistry::Resolved StrategyRegistry::resolve_composed(const VariantName& name) const {
  const std::string &build = name.stages[0].strategy, &find = name.stages[1].strategy;
  const auto known = arithmetics(constructions_);
  std::set<std::string> had;
  for (const StageEntry& c : constructions_)
    if (c.info.name == build) had.insert(c.arithmetic.name);
  const std::string arithmetic = arithmetic_meant(name, had);
  if (!known.contains(arithmetic))
    throw InputError(fmt::format("there is no arithmetic '{}'; there are: {}{}", arithmetic,
                                 fmt::join(known, ", "),
                                 did_you_mean(arithmetic, {known.begin(), known.end()})));

  const auto stage = [&](const std::vector<StageEntry>& entries, const std::string& wanted,
                         const char* kind) {
    std::set<std::string> names;
    const StageEntry* found = nullptr;
    for (const StageEntry& e : entries) {
      if (e.arithmetic.name != arithmetic) continue;
      names.insert(e.info.name);
      if (e.info.name == wanted) found = &e;
    }
    if (found == nullptr)
      throw InputError(fmt::format("there is no {} '{}' in {} arithmetic; there are: {}{}", kind, wanted,
                                   arithmetic, fmt::join(names, ", "), instead_of(wanted, names)));
    return found;
  };
  const StageEntry* c = stage(constructions_, build, "construction");
  const StageEntry* t = stage(traversals_, find, "traversal");
  if (!combine(*c, *t)) {
    std::set<std::string> partners;
    for (const StageEntry& e : traversals_)
      if (combine(*c, e)) partners.insert(e.info.name);
    throw InputError(fmt::format("{} takes another tree than {} makes; with {} go: {}", find, build, build,
                                 fmt::join(partners, ", ")));
  }
  return {nullptr, c, t};
}

StrategyRegistry::Resolved StrategyRegistry::resolve(const VariantName& name) const {
  return name.composed() ? resolve_composed(name)
                         : Resolved{resolve_whole(name.stages[0].strategy, name.arithmetic)};
}

VariantInfo StrategyRegistry::describe(std::string_view text) const {
  const VariantName name = VariantName::parse(text);
  const Resolved found = resolve(name);
  VariantInfo info = found.whole ? info_of(*found.whole) : info_of(*found.construction, *found.traversal);
  for (std::size_t k = 0; k < name.stages.size(); ++k) {
    const StrategyInfo& stage =
        found.whole ? found.whole->info : (k == 0 ? found.construction : found.traversal)->info;
    info.places[k] = place_of(stage, parameters_of(name.stages[k], stage));
    info.parts.stages[k].settings = name.stages[k].settings;
  }
  info.name = info.parts.text();
  return info;
}

std::unique_ptr<Variant> StrategyRegistry::make(std::string_view text) const {
  return std::make_unique<InDefaultFloats>(make_held(text));
}

std::unique_ptr<Variant> StrategyRegistry::make_held(std::string_view text) const {
  const DefaultFloats floats;
  const auto whole = [](const VariantEntry& entry, const Parameters& parameters) {
    require_available(entry.info);
    return entry.make(parameters);
  };
  // Nothing to take apart: to do so takes longer than to search a few spheres.
  if (text.find_first_of("()+/") == std::string_view::npos) {
    const VariantEntry& entry = *resolve_whole(text, {});
    return whole(entry, entry.defaults);
  }
  const VariantName name = VariantName::parse(text);
  const Resolved found = resolve(name);
  if (found.whole != nullptr) return whole(*found.whole, parameters_of(name.stages[0], found.whole->info));
  const StageEntry &c = *found.construction, &t = *found.traversal;
  require_available(c.info);
  require_available(t.info);
  const Parameters build = parameters_of(name.stages[0], c.info),
                   find = parameters_of(name.stages[1], t.info);
  const Place build_place = place_of(c.info, build), find_place = place_of(t.info, find);
  if (build_place.on_device() && find_place.on_device() && build_place != find_place)
    throw InputError(fmt::format("{}: both stages must be on one device, got {} and {}", text,
                                 build_place.index, find_place.index));
  const Place place = build_place.on_device() ? build_place : find_place;
  return c.tree.compose(c.make(build), build_place, t.make(find), find_place,
                        place.on_device() ? make_device(place) : nullptr);
}

VariantName StrategyRegistry::on_host(VariantName name) const {
  for (StageName& stage : name.stages) {
    const std::string twin = stage.strategy + std::string(StageName::on_host);
    if (find_strategy(twin) != nullptr) stage.strategy = twin;
  }
  return name;
}

}  // namespace catena
