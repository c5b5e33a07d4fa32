#include <cmath>

#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"

/// Tubes as they occur: walks, coils, knots.
namespace catena::properties {
namespace {

constexpr float two_pi = 6.28318530717958648f;

Draft walk(Dice& dice, std::uint32_t size) { return {tangle(dice, 1 + dice.below(size)), {}, {}}; }

/// Turns of a helix, from lying on each other to well apart.
Draft coil(Dice& dice, std::uint32_t size) {
  const std::uint32_t n = 1 + dice.below(size);
  const float turn = two_pi / static_cast<float>(3 + dice.below(12)),
              pitch = dice.pick({0.0f, 0.1f, 1.0f, 2.0f});
  const float width = 0.5f + dice.unit(), radius = dice.pick({0.05f, 0.25f, 0.5f});
  Draft draft;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float angle = turn * static_cast<float>(i);
    draft.spheres.push_back(
        {width * std::cos(angle), width * std::sin(angle), pitch * angle / two_pi, radius});
  }
  return draft;
}

/// A (p, q) torus knot, closed.
Draft knot(Dice& dice, std::uint32_t size) {
  const std::uint32_t n = 1 + dice.below(size);
  const float p = static_cast<float>(2 + dice.below(4)), q = static_cast<float>(3 + dice.below(5));
  const float radius = dice.pick({0.1f, 0.3f, 0.6f});
  Draft draft;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float t = two_pi * static_cast<float>(i) / static_cast<float>(n), ring = 2 + std::cos(q * t);
    draft.spheres.push_back({ring * std::cos(p * t), ring * std::sin(p * t), std::sin(q * t), radius});
  }
  draft.strands = Strands::one_closed(n);
  return draft;
}

const RegisterFamily walks{"walk", "tangled random walks", walk}, coils{"coil", "turns of a helix", coil},
    knots{"knot", "closed torus knots", knot, true};

}  // namespace
}  // namespace catena::properties
