#pragma once
#include <cmath>
#include <limits>

namespace catena {

/// The least binary32 number that is not below `value`; infinite past the largest. For a radius that must not
/// shrink when it is stored. `value` is no NaN. On the host: Robust has its own for devices.
inline float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  return double{nearest} >= value ? nearest : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

}  // namespace catena
