#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/pair.h"

namespace catena {

/// What the caller wants to know. Asking for less lets a strategy leave work out.
struct Request {
  enum class Want {
    any,     ///< only whether anything collides: the search may stop at the first pair
    counts,  ///< collisions of each sphere (the paper's output array)
    pairs    ///< counts and the pairs
  };
  Want want = Want::pairs;
  /// More pairs than this is an error with the true number, never a silent loss. The default is 1 GiB of
  /// pairs.
  std::uint64_t pair_limit = std::uint64_t{1} << 27;
};

/// The answer. Reused from call to call, so that its memory is too.
struct Collisions {
  bool found = false;                ///< at least one pair; the only member that Want::any fills
  std::uint64_t pair_count = 0;      ///< colliding pairs, each counted once
  std::vector<std::uint32_t> count;  ///< n entries: collisions of each sphere
  std::vector<Pair> pairs;           ///< i < j, each once, in no particular order
};

}  // namespace catena
