#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "catena/core/periodic/periodic.h"
#include "catena/core/strategy/registry.h"

namespace catena {

using Pairs = std::vector<Pair>;

/// What a variant finds in a box, with its pairs in order.
inline Collisions found(const std::string& variant, const Chain& chain, const PeriodicBox& box,
                 const Request& request = {}) {
  Periodic periodic(StrategyRegistry::instance().make(variant), box);
  Collisions result;
  periodic.prepare(request);
  periodic.build(chain);
  periodic.find(chain, request, result);
  std::ranges::sort(result.pairs);
  return result;
}

}  // namespace catena
