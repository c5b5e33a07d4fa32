#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "catena/core/pair.h"

namespace catena::properties {

/// Most variants give pairs in order already, and a look costs less than a sort.
inline void sort(std::vector<Pair>& pairs) {
  const auto key = [](const Pair& p) { return std::uint64_t{p.i} << 32 | p.j; };
  if (!std::ranges::is_sorted(pairs, {}, key)) std::ranges::sort(pairs, {}, key);
}

}  // namespace catena::properties
