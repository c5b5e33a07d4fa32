#pragma once
#include <bitset>
#include <span>

namespace catena::ranks {

/// The cores of a machine that a rank may run on.
using Cores = std::bitset<1024>;

/// How many cores the rank `own` of those on a machine may keep busy, when every core is shared evenly by the
/// ranks that may run on it: at least 1, also where the system does not say which those are. mpirun binds a
/// rank to a core, to a socket or to nothing, as it was told; without this, ranks of one machine would each
/// start a thread for every core. O(ranks).
inline unsigned core_share(std::span<const Cores> ranks, std::size_t own) {
  double share = 0;
  for (std::size_t core = 0; core < ranks[own].size(); ++core) {
    if (!ranks[own][core]) continue;
    unsigned sharing = 0;
    for (const Cores& cores : ranks) sharing += cores[core];
    share += 1.0 / sharing;
  }
  constexpr double rounding = 1e-6;
  return share < 1 ? 1 : static_cast<unsigned>(share + rounding);
}

}  // namespace catena::ranks
