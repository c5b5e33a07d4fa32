#pragma once
#include <cstdint>
#include <span>

#include "catena/core/pair.h"

namespace catena {

/// One more for both spheres of each pair.
inline void count_pairs(std::span<const Pair> pairs, std::span<std::uint32_t> counts) {
  for (const Pair& p : pairs) ++counts[p.i], ++counts[p.j];
}

}  // namespace catena
