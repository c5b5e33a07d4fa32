#pragma once
#include <bit>
#include <cstdint>

#include "catena/core/chain/chain.h"

namespace catena::bench {

/// One number for the stored spheres and strands of a chain, so that two measurements can be seen to be of
/// the same: FNV-1a over their bits, word by word, in order. O(n).
inline std::uint64_t chain_hash(const Chain& chain) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&](std::uint32_t word) { hash = (hash ^ word) * 0x100000001B3u; };
  for (const Sphere& s : chain.spheres())
    for (const float number : {s.x, s.y, s.z, s.radius}) add(std::bit_cast<std::uint32_t>(number));
  for (const std::uint32_t first : chain.strands().first) add(first);
  for (const std::uint8_t closed : chain.strands().closed) add(closed);
  return hash;
}

}  // namespace catena::bench
