#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "catena/properties/generators/draft.h"

namespace catena::properties {

/// A valid chain from any bytes, so that coverage guides what its numbers are: a byte for the rule, its
/// value, then 16 bytes a sphere. Numbers that are not finite become finite, negative radii positive.
inline Chain chain_from_bytes(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t most = 64;
  const auto byte = [&]() -> std::uint8_t { return size == 0 ? 0 : (--size, *data++); };
  const auto finite = [](std::uint32_t bits) {
    if ((bits >> 23 & 0xFF) == 0xFF) bits &= 0xBFFFFFFF;  // infinities and NaN lose an exponent bit
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  const std::uint8_t rule = byte(), value = byte();
  Draft draft;
  for (; size >= sizeof(Sphere) && draft.size() < most; data += sizeof(Sphere), size -= sizeof(Sphere)) {
    std::uint32_t bits[4];
    std::memcpy(bits, data, sizeof bits);
    draft.spheres.push_back(
        {finite(bits[0]), finite(bits[1]), finite(bits[2]), finite(bits[3] & 0x7FFFFFFF)});
  }
  const std::uint32_t n = draft.size();
  if (rule & 1) draft.exclusion = Exclusion::index(1 + value % 8);
  if (rule & 2) draft.exclusion = Exclusion::arc((1 + value) / 16.0);
  if (rule & 4) draft.strands = {{0, value % (n + 1), n}, {static_cast<std::uint8_t>(rule >> 4 & 1), 0}};
  if ((rule & 12) == 8) draft.strands = Strands::one_closed(n);
  if ((rule & 32) && n >= 2) draft.exclusion.extra_pairs.push_back({value % n, (value + 1u) % n});
  return std::move(draft).chain();
}

}  // namespace catena::properties
