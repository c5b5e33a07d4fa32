#pragma once
#include <compare>
#include <cstdint>

namespace catena {

/// Two colliding spheres by their index in the chain, always i < j.
struct Pair {
  std::uint32_t i, j;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

}  // namespace catena
