#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/pair.h"

namespace catena::reference {

/// The right answer for a chain.
struct Answer {
  std::uint64_t pair_count = 0;      ///< colliding pairs, each counted once
  std::vector<std::uint32_t> count;  ///< n entries: collisions of each sphere
  bool has_pairs = true;             ///< false: counts only, as requested; `pairs` is empty then
  std::vector<Pair> pairs;           ///< i < j, sorted, each once

  friend bool operator==(const Answer&, const Answer&) = default;
};

}  // namespace catena::reference
