#pragma once
#include <compare>
#include <cstdint>

#include "catena/core/export.h"

namespace catena {

/// Two colliding spheres by their index in the chain, always i < j.
struct CATENA_API Pair {
  std::uint32_t i, j;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

}  // namespace catena
