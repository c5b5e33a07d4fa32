#include <array>
#include <cmath>

#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"

/// Pairs that touch exactly, or almost: where one rounding decides.
namespace catena::properties {
namespace {

/// A walk on the integer lattice, at any scale of binary32.
Draft lattice(Dice& dice, std::uint32_t size) {
  Draft draft{integer_walk(dice, 1 + dice.below(size)), {}, {}};
  if (dice.one_in(2)) scale(draft.spheres, dice.between(-147, 121));
  return draft;
}

/// Steps whose length is a whole number, radii that add up to it: touching in all three axes at once.
std::vector<Sphere> quadruples(Dice& dice, std::uint32_t n) {
  constexpr std::array<std::array<float, 4>, 6> steps{
      {{1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9}, {2, 6, 9, 11}, {3, 4, 12, 13}, {0, 3, 4, 5}}};
  std::vector<Sphere> spheres;
  Sphere s{0, 0, 0, 1};
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back(s);
    const auto& step = steps[dice.below(steps.size())];
    const std::uint32_t turn = dice.below(3);
    const auto component = [&](std::uint32_t k) {
      return dice.one_in(2) ? step[(k + turn) % 3] : -step[(k + turn) % 3];
    };
    s = {s.x + component(0), s.y + component(1), s.z + component(2),
         s.radius < step[3] ? step[3] - s.radius : 1};
    // A sphere with no neighbour's place: a lone bystander keeps the touching two from being neighbours.
    if (dice.one_in(2) && ++i < n) spheres.push_back({1000, static_cast<float>(i) * 100, 1000, 1});
  }
  return spheres;
}

Draft touching(Dice& dice, std::uint32_t size) {
  Draft draft{quadruples(dice, 1 + dice.below(size)), {}, {}};
  if (dice.one_in(2)) scale(draft.spheres, dice.between(-140, 100));
  return draft;
}

/// Exactly touching pairs moved by up to 4 ulp, in some numbers or in all.
Draft ulps(Dice& dice, std::uint32_t size) {
  const std::uint32_t n = 1 + dice.below(size);
  Draft draft{dice.one_in(2) ? quadruples(dice, n) : integer_walk(dice, n), {}, {}};
  if (dice.one_in(3)) scale(draft.spheres, dice.between(-147, 100));
  const std::uint32_t rarity = dice.pick({1u, 4u, 16u});
  for (Sphere& s : draft.spheres)
    for (float* number : {&s.x, &s.y, &s.z, &s.radius})
      if (dice.one_in(rarity)) *number = moved_by_ulps(*number, dice.between(-4, 4));
  for (Sphere& s : draft.spheres) s.radius = std::fabs(s.radius);
  return draft;
}

const RegisterFamily on_lattice{"lattice", "the integer lattice: neighbours touch exactly", lattice},
    exactly{"touching", "exactly touching by Pythagorean quadruples", touching},
    nearly{"ulps", "exactly touching, moved by up to 4 ulp", ulps};

}  // namespace
}  // namespace catena::properties
