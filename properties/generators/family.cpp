#include "catena/properties/generators/family.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/properties/generators/rules.h"

namespace catena::properties {

FamilyRegistry& FamilyRegistry::instance() {
  static FamilyRegistry registry;
  return registry;
}

std::vector<Family> FamilyRegistry::families() const {
  auto sorted = families_;
  std::ranges::sort(sorted, {}, &Family::name);
  return sorted;
}

Family FamilyRegistry::family(std::string_view name) const {
  std::vector<std::string> names;
  for (const Family& f : families()) {
    if (f.name == name) return f;
    names.push_back(f.name);
  }
  throw InputError(
      fmt::format("there is no family '{}' of chains; there are: {}{}", name, fmt::join(names, ", "),
                  did_you_mean(name, names)));
}

Chain generate(const Family& family, Dice& dice, std::uint32_t size) {
  Draft draft = family.draw(dice, size);
  if (!family.sets_rule && dice.one_in(4)) change_rule(draft, dice);
  return std::move(draft).chain();
}

}  // namespace catena::properties
