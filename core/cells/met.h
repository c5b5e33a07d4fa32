#pragma once
#include <cstdint>

namespace catena {

/// Two spheres that came near one another, and whether they collide.
struct Met {
  std::uint32_t i, j;  ///< in either order
  bool collide;
};

}  // namespace catena
