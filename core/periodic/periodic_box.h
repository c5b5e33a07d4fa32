#pragma once
#include <array>

namespace catena {

/// A box that repeats itself in space: edges a = (length[0], 0, 0), b = (xy, length[1], 0) and c = (xz, yz,
/// length[2]). A length of 0: it does not repeat along that edge. Every number is binary64, as a user writes
/// it, and is exact from there on. Where it begins does not matter.
struct PeriodicBox {
  std::array<double, 3> length{};
  double xy = 0, xz = 0, yz = 0;
  friend bool operator==(const PeriodicBox&, const PeriodicBox&) = default;
};

}  // namespace catena
