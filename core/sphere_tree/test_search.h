#pragma once
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/executor/pair_collector.h"
#include "catena/core/sphere_tree/sphere_kernels.h"
#include "catena/properties/sorted_pairs.h"

namespace catena {

/// The pairs that a search of the tree finds, sorted, for tests; the queues tell what it met.
inline std::vector<Pair> pairs_of(const Chain& chain, const SphereTree& tree, SphereQueues& queues) {
  Collisions found;
  PairCollector collector(chain.size(), {}, found);
  search_sphere_tree(chain.view(), tree, {&queues, 1}, collector, Team());
  collector.finish();
  properties::sort(found.pairs);
  return found.pairs;
}

}  // namespace catena
