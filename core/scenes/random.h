#pragma once
#include <cstdint>
#include <random>

#include "catena/core/vec3.h"

namespace catena {

/// Seeded random numbers with the same bits everywhere: the C++ standard fixes std::mt19937_64 but not what
/// the std distributions make of it.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  /// Uniform in [-1, 1).
  double symmetric() { return 2 * unit() - 1; }
  /// Uniform in the cube [-1, 1)^3; the members are drawn in the order x, y, z.
  Vec3 cube() {
    const double x = symmetric(), y = symmetric(), z = symmetric();
    return {x, y, z};
  }
  /// A uniformly distributed direction of length 1, by rejection from the cube.
  Vec3 direction() {
    for (;;) {
      const Vec3 v = cube();
      const double squared = dot(v, v);
      if (squared > 0.01 && squared < 1) return 1 / length(v) * v;
    }
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace catena
