#include "catena/core/plan/find.h"

#include "catena/core/strategy/registry.h"

namespace catena {

Collisions find(const Chain& chain, const Request& request) {
  const auto variant = StrategyRegistry::instance().make("auto");
  variant->prepare(request);
  variant->build(chain);
  Collisions found;
  variant->find(chain, request, found);
  return found;
}

}  // namespace catena
