#include <cmath>

#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"

/// What fixed sizes in an algorithm must survive: numbers of spheres at their limits, trees as deep as codes
/// are wide.
namespace catena::properties {
namespace {

/// n at and next to a power of two, the paper's subtree (384) or block (768 threads, 1,536 leaves), as far as
/// `size` allows.
Draft limit(Dice& dice, std::uint32_t size) {
  std::uint32_t n;
  do {
    const std::uint32_t round = dice.one_in(2) ? dice.pick({384u, 768u, 1536u, 2304u}) : 1u << dice.below(12);
    n = round - 1 + dice.below(3);
  } while (n == 0 || n > size);
  return {dice.one_in(3) ? integer_walk(dice, n) : tangle(dice, n), {}, {}};
}

/// Clusters that halve their distance to a corner: a tree over Morton codes becomes as deep as its codes are
/// wide, and overlapping bounds fill a stack with one node a level. Duplicates at the corner defeat the
/// tie-break.
Draft corner(Dice& dice, std::uint32_t size) {
  const std::uint32_t n = 1 + dice.below(size), duplicates = dice.below(5);
  const float reach = dice.pick({0x1p-30f, 0.01f, 0.5f, 2.0f});
  const bool shuffled = dice.one_in(2);
  Draft draft;
  for (std::uint32_t i = 0; i < n; ++i) {
    const float gap = i < duplicates ? 0 : std::ldexp(1.0f, -static_cast<int>((i - duplicates) % 40));
    draft.spheres.push_back({1 - gap, dice.one_in(8) ? 1.0f : 1 - gap, 1 - gap, reach});
  }
  for (std::uint32_t i = n; shuffled && i > 1; --i)
    std::swap(draft.spheres[i - 1], draft.spheres[dice.below(i)]);
  return draft;
}

const RegisterFamily sizes{"sizes", "n at powers of two, 384, 768, 1536 and one off", limit},
    corners{"corner", "clusters converging to a corner, with duplicates", corner};

}  // namespace
}  // namespace catena::properties
