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

/// Of fewer spheres a tree is less deep, and all of it stays next to the core: what a search of spheres one
/// by one takes, of that of many.
inline double shallow_share(std::uint32_t spheres) {
  constexpr double deep = 20'000, octave = 0.065, least = 0.78;
  return std::clamp(1 - octave * std::log2(deep / std::max(1u, spheres)), least, 1.0);
}

}  // namespace catena
