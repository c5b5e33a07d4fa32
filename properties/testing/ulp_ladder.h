#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "catena/core/sphere.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/shapes.h"

namespace catena::properties {

/// Two spheres that touch exactly.
struct TouchingPair {
  Sphere a, b;
};

/// Touching by Pythagorean quadruples, turned, at many places and scales; every number exact.
inline std::vector<TouchingPair> touching_pairs() {
  constexpr std::array<std::array<float, 4>, 8> steps{{{1, 0, 0, 1},
                                                       {1, 2, 2, 3},
                                                       {2, 3, 6, 7},
                                                       {1, 4, 8, 9},
                                                       {2, 6, 9, 11},
                                                       {3, 4, 12, 13},
                                                       {0, 3, 4, 5},
                                                       {8, 9, 12, 17}}};
  std::vector<TouchingPair> pairs;
  Dice dice(1);
  for (const int exponent : {-140, -100, -60, -46, -20, 0, 20, 50, 63, 100, 118})
    for (const auto& step : steps)
      for (int turn = 0; turn < 3; ++turn)
        for (const float share : {0.0f, 0.25f, 0.5f}) {
          const auto place = [&] { return static_cast<float>(dice.between(-99, 99)); };
          const auto sign = [&] { return dice.one_in(2) ? 1.0f : -1.0f; };
          const std::size_t t = static_cast<std::size_t>(turn);
          const Sphere a{place(), place(), place(), share * step[3]};
          const Sphere b{a.x + sign() * step[t], a.y + sign() * step[(t + 1) % 3],
                         a.z + sign() * step[(t + 2) % 3], step[3] - a.radius};
          std::vector<Sphere> both{a, b};
          scale(both, exponent);
          pairs.push_back({both[0], both[1]});
        }
  return pairs;
}

/// visit(step, radius, a, b) for every touching pair, each of its numbers and every step of -4 to 4 ulps;
/// `radius` says that it is a radius, which does not fall below 0.
template <class Visit>
void climb_ulps(const Visit& visit) {
  constexpr float Sphere::*members[] = {&Sphere::x, &Sphere::y, &Sphere::z, &Sphere::radius};
  for (const TouchingPair& pair : touching_pairs())
    for (int number = 0; number < 8; ++number)
      for (int step = -4; step <= 4; ++step) {
        TouchingPair moved = pair;
        Sphere& sphere = number < 4 ? moved.a : moved.b;
        float& value = sphere.*members[number % 4];
        value = moved_by_ulps(value, step);
        if (moved.a.radius < 0 || moved.b.radius < 0) continue;
        visit(step, number % 4 == 3, moved.a, moved.b);
      }
}

}  // namespace catena::properties
