#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace catena {

/// How often so many spheres, sorted by place, are twice what a core's own cache holds, about; 0 for fewer.
inline double octaves_beyond_cache(std::uint32_t spheres) {
  constexpr double in_cache = 1 << 16;
  return std::max(0.0, std::log2(spheres / in_cache));
}

}  // namespace catena
