#pragma once
#include <string>

#include "catena/core/strategy/registry.h"
#include "catena/properties/sorted_pairs.h"

namespace catena::properties {

/// What the variant of that name, made anew, answers; its pairs ascend.
inline Collisions answer_of(const std::string& name, const Chain& chain, const Request& request = {}) {
  const auto variant = StrategyRegistry::instance().make(name);
  Collisions found;
  variant->prepare(request);
  variant->build(chain);
  variant->find(chain, request, found);
  sort(found.pairs);
  return found;
}

}  // namespace catena::properties
