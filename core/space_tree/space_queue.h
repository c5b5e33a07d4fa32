#pragma once
#include <cstdint>

#include "catena/core/executor/large_vector.h"
#include "catena/core/pair.h"

namespace catena {

/// What a walk of a SpaceTree has found and not looked into yet: past `limit` pairs it is worked off.
struct SpaceQueue {
  static constexpr std::size_t limit = 1024, room = limit + 16 * 16 + 16;
  std::uint64_t done = 0;  ///< pairs worked off since this was made
  LargeVector<Pair> pairs = LargeVector<Pair>(room);
};

}  // namespace catena
