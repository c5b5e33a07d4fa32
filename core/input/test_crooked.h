#pragma once
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "catena/core/sphere.h"
#include "catena/core/vec3.h"

namespace catena {

inline Vec3 centre(const Sphere& s) { return {s.x, s.y, s.z}; }
inline float rounded(double number) { return static_cast<float>(number); }

/// A tube that bends, twists and swells by chance, in fine steps.
inline std::vector<Sphere> crooked(std::mt19937& random, std::uint32_t n) {
  std::normal_distribution<double> turn(0, 0.03);
  std::vector<Sphere> spheres;
  Vec3 at{3, -2, 1}, step{0.1, 0, 0};
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back({rounded(at.x), rounded(at.y), rounded(at.z), rounded(1 + 0.3 * std::sin(0.05 * i))});
    step = step + Vec3{turn(random), turn(random), turn(random)};
    step = 0.1 / length(step) * step;
    at = at + step;
  }
  return spheres;
}

}  // namespace catena
