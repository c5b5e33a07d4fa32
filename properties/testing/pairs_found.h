#pragma once
#include <string>
#include <utility>
#include <vector>

#include "catena/core/strategy/registry.h"
#include "catena/properties/sorted_pairs.h"

namespace catena::properties {

/// The pairs of one search by this variant, sorted.
inline std::vector<Pair> pairs_found(const std::string& variant_name, const Chain& chain) {
  const auto variant = StrategyRegistry::instance().make(variant_name);
  Collisions found;
  variant->build(chain);
  variant->find(chain, {}, found);
  sort(found.pairs);
  return std::move(found.pairs);
}

}  // namespace catena::properties
