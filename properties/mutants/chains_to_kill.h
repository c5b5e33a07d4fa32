#pragma once
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"

namespace catena::properties::testing {

struct NamedChain {
  std::string name;
  Chain chain;
};

/// Chains by which mutants are told from the right thing, cheap ones first; the same every time. `small` of
/// them have at most 64 spheres or so and are shown to every mutant, the others to those that are left.
struct ChainsToKill {
  std::vector<NamedChain> chains;
  std::size_t small = 0;
};
ChainsToKill chains_to_kill();

}  // namespace catena::properties::testing
