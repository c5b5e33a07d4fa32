#pragma once
#include <cstdint>
#include <span>

#include "catena/core/pair.h"

namespace catena::properties {

/// One number for a pair set, the same in any order, on every machine and for every variant: the sum of a mix
/// (splitmix64) of each pair. A repeated pair changes it. O(p).
inline std::uint64_t pair_set_hash(std::span<const Pair> pairs) {
  std::uint64_t sum = pairs.size();
  for (const Pair& p : pairs) {
    std::uint64_t z = (std::uint64_t{p.i} << 32 | p.j) + 0x9E3779B97F4A7C15u;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
    z = (z ^ z >> 27) * 0x94D049BB133111EBu;
    sum += z ^ z >> 31;
  }
  return sum;
}

}  // namespace catena::properties
