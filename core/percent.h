#pragma once
#include <fmt/format.h>

#include <string>

namespace catena {

/// "2.5 %" of a share of 0.025: two digits, but never 1e+02 for all of it.
inline std::string percent(double share) {
  return 100 * share < 99.5 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

}  // namespace catena
