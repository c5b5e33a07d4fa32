#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/part.h"

namespace catena::ranks {

/// Blocks that follow one another on a strand and go to one rank.
struct Run {
  SphereId first;
  std::uint64_t size;
  Strand strand;
};

/// What goes to one rank: runs, and where they begin in the part, ascending.
struct Share {
  std::vector<Run> runs;
  std::vector<std::uint32_t> begin;
};

/// Of what each sphere of a part has one, each rank's share to it, and in their place what the others send:
/// by rising ranks, this one's own among them. `coming`: how many come of each rank, of this one how many
/// stay. In so many rounds, the same on all ranks: what is on its way is no more than one of them brings.
/// Besides it takes the memory of the new values, while that of the old ones is given back. All ranks call
/// it.
template <class Value>
void move_shares(Communicator& ranks, const std::vector<Share>& shares, std::span<const std::uint64_t> coming,
                 std::uint64_t rounds, std::vector<Value>& values);

}  // namespace catena::ranks
