#include "catena/core/strategy/registry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "catena/core/error.h"

namespace catena {
namespace {

std::string full_name(const std::string& strategy, const std::string& arithmetic) {
  return arithmetic == Robust::name ? strategy : strategy + "/" + arithmetic;
}

std::optional<std::string> reason(const StrategyInfo& info) {
  return info.unavailable ? info.unavailable() : std::nullopt;
}

void require_available(const StrategyInfo& info) {
  if (const auto why = reason(info))
    throw CapacityError(fmt::format("{} is not available here: {}", info.name, *why));
}

template <class Entries>
auto* find_entry(Entries& entries, const std::string& name, const std::string& arithmetic) {
  const auto found = std::ranges::find_if(
      entries, [&](const auto& e) { return e.info.name == name && e.arithmetic == arithmetic; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

StrategyRegistry& StrategyRegistry::instance() {
  static StrategyRegistry registry;
  return registry;
}

void StrategyRegistry::add_variant(const StrategyInfo& info, std::string arithmetic, MakeVariant make,
                                   bool hidden) {
  complete_.push_back({info, std::move(arithmetic), hidden, std::move(make)});
}

template <class Arithmetic>
void StrategyRegistry::list_composed(std::vector<VariantInfo>& out) const {
  const auto& [constructions, traversals] = stages<typename Arithmetic::Bound>();
  for (const auto& c : constructions) {
    if (c.arithmetic != Arithmetic::name) continue;
    for (const auto& t : traversals) {
      if (t.arithmetic != Arithmetic::name) continue;
      const auto why = reason(c.info) ? reason(c.info) : reason(t.info);
      out.push_back({full_name(c.info.name + "+" + t.info.name, Arithmetic::name), Arithmetic::name,
                     c.info.summary + "; " + t.info.summary,
                     c.info.space == Space::device || t.info.space == Space::device, false, false, why});
    }
  }
}

std::vector<VariantInfo> StrategyRegistry::variants(bool with_hidden) const {
  std::vector<VariantInfo> list;
  for (const Entry& e : complete_)
    if (with_hidden || !e.hidden)
      list.push_back({full_name(e.info.name, e.arithmetic), e.arithmetic, e.info.summary,
                      e.info.space == Space::device, e.info.all_pairs, e.hidden, reason(e.info)});
  list_composed<Robust>(list);
  list_composed<Literal>(list);
  list_composed<Double>(list);
  std::ranges::sort(list, {}, &VariantInfo::name);
  return list;
}

std::vector<std::string> StrategyRegistry::strategy_names() const {
  std::set<std::string> names;
  const auto collect = [&](const auto& entries) {
    for (const auto& e : entries) names.insert(e.info.name);
  };
  for (const Entry& e : complete_)
    if (!e.hidden) names.insert(e.info.name);
  collect(narrow_.constructions), collect(narrow_.traversals);
  collect(wide_.constructions), collect(wide_.traversals);
  return {names.begin(), names.end()};
}

const StrategyInfo* StrategyRegistry::find_strategy(const std::string& name) const {
  const StrategyInfo* found = nullptr;
  const auto look = [&](const auto& entries) {
    for (const auto& e : entries)
      if (e.info.name == name) found = &e.info;
  };
  look(complete_), look(narrow_.constructions), look(narrow_.traversals);
  look(wide_.constructions), look(wide_.traversals);
  return found;
}

const StrategyInfo& StrategyRegistry::strategy(const std::string& name) const {
  const StrategyInfo* found = find_strategy(name);
  if (found == nullptr)
    throw InputError(
        fmt::format("there is no strategy '{}'; there are: {}", name, fmt::join(strategy_names(), ", ")));
  return *found;
}

template <class Arithmetic>
std::unique_ptr<Variant> StrategyRegistry::make_composed(const StrategySpec& build,
                                                         const StrategySpec& find) const {
  const auto& [constructions, traversals] = stages<typename Arithmetic::Bound>();
  const auto* c = find_entry(constructions, build.name, Arithmetic::name);
  const auto* t = find_entry(traversals, find.name, Arithmetic::name);
  const auto names = [](const auto& entries) {
    std::set<std::string> set;
    for (const auto& e : entries)
      if (e.arithmetic == Arithmetic::name) set.insert(e.info.name);
    return set;
  };
  if (c == nullptr)
    throw InputError(fmt::format("there is no construction '{}' in {} arithmetic; there are: {}", build.name,
                                 Arithmetic::name, fmt::join(names(constructions), ", ")));
  if (t == nullptr)
    throw InputError(fmt::format("there is no traversal '{}' in {} arithmetic; there are: {}", find.name,
                                 Arithmetic::name, fmt::join(names(traversals), ", ")));
  require_available(c->info);
  require_available(t->info);
  const bool device = c->info.space == Space::device || t->info.space == Space::device;
  return std::make_unique<Composed<Arithmetic>>(
      c->make(Parameters(build.name, c->info.parameters, build.parameters)), c->info.space,
      t->make(Parameters(find.name, t->info.parameters, find.parameters)), t->info.space,
      device ? make_mover() : nullptr);
}

std::unique_ptr<Variant> StrategyRegistry::make_complete(const StrategySpec& spec,
                                                         const std::string& arithmetic) const {
  std::vector<std::string> others;
  for (const Entry& e : complete_) {
    if (e.info.name != spec.name) continue;
    if (e.arithmetic == arithmetic) {
      require_available(e.info);
      return e.make(Parameters(spec.name, e.info.parameters, spec.parameters));
    }
    others.push_back(e.arithmetic);
  }
  if (!others.empty())
    throw InputError(
        fmt::format("'{}' has no {} arithmetic; it has: {}", spec.name, arithmetic, fmt::join(others, ", ")));
  strategy(spec.name);  // throws when there is no such strategy at all
  throw InputError(
      fmt::format("'{}' is one stage only; write construction+traversal, as in aCPU2+CPU2", spec.name));
}

std::unique_ptr<Variant> StrategyRegistry::make(std::string_view name) const {
  const auto slash = name.find('/');
  const std::string arithmetic(slash == std::string_view::npos ? Robust::name : name.substr(slash + 1));
  const std::string_view stem = name.substr(0, slash);
  const auto plus = stem.find('+');
  if (plus == std::string_view::npos) return make_complete(StrategySpec::parse(stem), arithmetic);

  const auto build = StrategySpec::parse(stem.substr(0, plus)),
             find = StrategySpec::parse(stem.substr(plus + 1));
  if (arithmetic == Robust::name) return make_composed<Robust>(build, find);
  if (arithmetic == Literal::name) return make_composed<Literal>(build, find);
  if (arithmetic == Double::name) return make_composed<Double>(build, find);
  throw InputError(fmt::format("there is no arithmetic '{}'; there are: {}, {}, {}", arithmetic, Robust::name,
                               Literal::name, Double::name));
}

}  // namespace catena
