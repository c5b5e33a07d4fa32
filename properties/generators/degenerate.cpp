#include <algorithm>

#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"

/// Chains without volume, direction or distance.
namespace catena::properties {
namespace {

/// On one line, back and forth: an axis, a diagonal, or any direction (then only nearly collinear, by
/// rounding).
Draft collinear(Dice& dice, std::uint32_t size) {
  const std::uint32_t n = 1 + dice.below(size);
  const float direction[] = {dice.symmetric(), dice.symmetric(), dice.symmetric()};
  const std::uint32_t kind = dice.below(3);
  const float back = dice.pick({0.0f, 0.3f, 0.5f}), radius = dice.pick({0.25f, 0.5f, 1.0f});
  Draft draft;
  float along = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float x = kind == 2 ? along * direction[0] : along;
    const float y = kind == 2 ? along * direction[1] : kind == 1 ? along : 0;
    const float z = kind == 2 ? along * direction[2] : kind == 1 ? -along : 0;
    draft.spheres.push_back({x, y, z, radius});
    along += dice.unit() < back ? -1.0f : 1.0f;
  }
  return draft;
}

/// All at one place, or at a few.
Draft coincident(Dice& dice, std::uint32_t size) {
  const auto places = tangle(dice, 1 + dice.below(3));
  const bool equal = dice.one_in(2);
  Draft draft{std::vector<Sphere>(1 + dice.below(size), places[0]), {}, {}};
  for (Sphere& s : draft.spheres) {
    const float radius = s.radius;
    s = places[dice.below(static_cast<std::uint32_t>(places.size()))];
    s.radius = equal ? radius : radius * dice.unit();
  }
  return draft;
}

/// Each in the one before, many touching it from within: the centre moves by exactly the difference of radii.
Draft nested(Dice& dice, std::uint32_t size) {
  Draft draft;
  Sphere s{0, 0, 0, 1024};
  for (std::uint32_t n = 1 + dice.below(size); n > 0; --n) {
    draft.spheres.push_back(s);
    const float shrink = s.radius / dice.pick({2.0f, 4.0f, 1024.0f});
    float* axis = dice.pick({&s.x, &s.y, &s.z});
    if (!dice.one_in(3)) *axis += dice.one_in(2) ? shrink : -shrink;
    s.radius -= shrink;
  }
  if (dice.one_in(2)) std::ranges::reverse(draft.spheres);
  return draft;
}

/// Zero radii, all or most: points touch only where they coincide.
Draft points(Dice& dice, std::uint32_t size) {
  Draft draft{
      dice.one_in(2) ? integer_walk(dice, 1 + dice.below(size)) : tangle(dice, 1 + dice.below(size)), {}, {}};
  const bool all = dice.one_in(2);
  for (Sphere& s : draft.spheres)
    if (all || !dice.one_in(4)) s.radius = 0;
  return draft;
}

const RegisterFamily on_lines{"collinear", "on one line, back and forth", collinear},
    at_places{"coincident", "many spheres at one to three places", coincident},
    in_each_other{"nested", "one in the other, many touching from within", nested},
    zero_radii{"points", "zero radii", points};

}  // namespace
}  // namespace catena::properties
