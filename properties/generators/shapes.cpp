#include "catena/properties/generators/shapes.h"

#include <cmath>
#include <limits>

namespace catena::properties {

std::vector<Sphere> tangle(Dice& dice, std::uint32_t n) {
  const float thickness = dice.pick({0.1f, 0.3f, 0.5f, 1.0f, 2.0f}),
              step = dice.pick({0.5f, 1.0f, 1.0f, 2.0f});
  const bool equal = dice.one_in(2);
  std::vector<Sphere> spheres;
  spheres.reserve(n);
  float x = 0, y = 0, z = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back({x, y, z, equal ? thickness : thickness * (0.5f + dice.unit())});
    x += step * dice.symmetric(), y += step * dice.symmetric(), z += step * dice.symmetric();
  }
  return spheres;
}

std::vector<Sphere> integer_walk(Dice& dice, std::uint32_t n) {
  const bool mixed = dice.one_in(3);
  std::vector<Sphere> spheres;
  spheres.reserve(n);
  float at[3] = {0, 0, 0};
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back({at[0], at[1], at[2], mixed ? 0.5f * static_cast<float>(dice.below(4)) : 0.5f});
    at[dice.below(3)] += dice.one_in(2) ? 1.0f : -1.0f;
  }
  return spheres;
}

float any_float(Dice& dice, int least, int greatest) {
  const float significand = dice.one_in(2) ? 1.0f : 1 + dice.unit();
  // ldexp rounds below the normal numbers, which is as good a denormal as any.
  const float value = std::ldexp(significand, dice.between(least, greatest));
  const float finite = std::isfinite(value) ? value : std::numeric_limits<float>::max();
  return dice.one_in(2) ? finite : -finite;
}

float moved_by_ulps(float value, int steps) {
  constexpr float largest = std::numeric_limits<float>::max();
  for (; steps > 0; --steps) value = std::nextafter(value, largest);
  for (; steps < 0; ++steps) value = std::nextafter(value, -largest);
  return value;
}

void scale(std::vector<Sphere>& spheres, int exponent) {
  for (Sphere& s : spheres) {
    const Sphere t{std::ldexp(s.x, exponent), std::ldexp(s.y, exponent), std::ldexp(s.z, exponent),
                   std::ldexp(s.radius, exponent)};
    if (std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.z) && std::isfinite(t.radius)) s = t;
  }
}

}  // namespace catena::properties
