#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "catena/core/sphere.h"

namespace catena::properties {

/// n spheres with centres in a cube of side 2 * greatest about the origin, radii up to an eighth of
/// `greatest`; where that is near the end of binary32, so large that ends of their boxes are infinite.
inline std::vector<Sphere> random_spheres(std::size_t n, std::mt19937& dice, float greatest) {
  std::uniform_real_distribution<float> at(-greatest, greatest),
      radius(0, greatest > 1e30f ? 1.9f * greatest : greatest / 8);
  std::vector<Sphere> spheres;
  for (std::size_t k = 0; k < n; ++k) spheres.push_back({at(dice), at(dice), at(dice), radius(dice)});
  return spheres;
}

/// n spheres of radius 1/2 with centres anywhere in a cube, one in so much `volume`.
inline std::vector<Sphere> spheres_in_volume(std::uint32_t n, float volume, std::mt19937& dice) {
  const float side = std::cbrt(static_cast<float>(n) * volume);
  std::uniform_real_distribution<float> at(-side / 2, side / 2);
  std::vector<Sphere> spheres;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float x = at(dice), y = at(dice), z = at(dice);
    spheres.push_back({x, y, z, 0.5f});
  }
  return spheres;
}

}  // namespace catena::properties
