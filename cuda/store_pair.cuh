#pragma once
#include <cstdint>

#include "catena/core/pair.h"

namespace catena::cuda {

/// Into an answer, which is not read again soon: what is stays in the device's cache.
__device__ inline void store_pair(Pair* to, std::uint32_t i, std::uint32_t j) {
  __stcs(&to->i, i);
  __stcs(&to->j, j);
}

}  // namespace catena::cuda
