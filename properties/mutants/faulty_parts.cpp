#include "catena/properties/mutants/faulty_parts.h"

#include <algorithm>
#include <stdexcept>

#include "catena/core/executor/team.h"
#include "catena/core/parts/part_as_chain.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/mutants/asked_of_all.h"

namespace catena::properties {

using parts::LocalChain;

void FaultyParts::find(const Chain& chain, const Request& request, Collisions& result) {
  if (built_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
  result = {};
  result.count.assign(chain.size(), 0);
  parts::Partition partition = parts::part_chain(chain, 3, {.group = 1, .order = order()}, Team());
  for (parts::PartRanges& ranges : partition.parts) {
    spoil(ranges);
    search(chain, LocalChain(chain, ranges), result);
  }
  leave_what_was_asked(request, result);
}

void FaultyParts::search(const Chain& chain, const LocalChain& part, Collisions& result) {
  const Chain local = spoiled(parts::part_as_chain(chain, part));
  const auto variant = StrategyRegistry::instance().make("Hybrid");
  variant->build(local);
  Collisions found;
  variant->find(local, {.queries = asked(part)}, found);
  for (const Pair& pair : found.pairs) {
    const std::uint32_t a = part.id(pair.i), b = part.id(pair.j), i = std::min(a, b), j = std::max(a, b);
    result.pairs.push_back({i, j});
    ++result.count[i], ++result.count[j];
  }
}
}  // namespace catena::properties
