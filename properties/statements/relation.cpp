#include "catena/properties/statements/relation.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/properties/sorted_pairs.h"

namespace catena::properties {

std::optional<std::string> Relation::check(const Subject&, Variant& variant, const Case& test) {
  const std::optional<Image>& expected = expected_(test, [&] {
    auto made = image(test);
    if (made) sort(made->pairs);
    return made;
  });
  if (!expected) return std::nullopt;
  variant.build(expected->chain);
  variant.find(expected->chain, {}, found_);
  sort(found_.pairs);
  if (found_.pairs == expected->pairs) return std::nullopt;
  const auto [mine, theirs] = std::ranges::mismatch(found_.pairs, expected->pairs);
  const bool missing = mine == found_.pairs.end() || (theirs != expected->pairs.end() && *theirs < *mine);
  const Pair first = missing ? *theirs : *mine;
  return fmt::format("{} pairs instead of {}; pair ({}, {}) of the changed chain is {}", found_.pairs.size(),
                     expected->pairs.size(), first.i, first.j, missing ? "missing" : "invented");
}

}  // namespace catena::properties
