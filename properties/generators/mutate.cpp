#include "catena/properties/generators/mutate.h"

#include <algorithm>
#include <cmath>

#include "catena/properties/generators/draft.h"
#include "catena/properties/generators/rules.h"
#include "catena/properties/generators/shapes.h"

namespace catena::properties {
namespace {

constexpr float Sphere::*members[] = {&Sphere::x, &Sphere::y, &Sphere::z, &Sphere::radius};

/// The float nearest to what makes `s` touch `other`; an ulp decides.
float touching_radius(const Sphere& s, const Sphere& other) {
  const double dx = double{s.x} - other.x, dy = double{s.y} - other.y, dz = double{s.z} - other.z;
  return static_cast<float>(std::sqrt(dx * dx + dy * dy + dz * dz) - other.radius);
}

void edit_number(Draft& draft, Dice& dice) {
  Sphere& s = draft.spheres[dice.below(draft.size())];
  const Sphere& other = draft.spheres[dice.below(draft.size())];
  const auto member = members[dice.below(4)];
  switch (dice.below(6)) {
    case 0:
      s.*member = moved_by_ulps(s.*member, dice.between(-2, 2));
      break;
    case 1:
      s.*member = std::ldexp(s.*member, dice.between(-3, 3));
      break;
    case 2:
      s.*member = other.*member;
      break;
    case 3:
      s.radius = touching_radius(s, other);
      break;
    case 4:
      s.*member = any_float(dice);
      break;
    default:
      s.*member += dice.symmetric() * (s.radius + other.radius);
  }
  s.radius = std::fabs(s.radius);
}

void edit_spheres(Draft& draft, Dice& dice, std::uint32_t size) {
  const std::uint32_t at = dice.below(draft.size()), other = dice.below(draft.size());
  switch (dice.below(4)) {
    case 0:
      if (draft.size() < size) draft.repeat(at);
      break;
    case 1:
      if (draft.size() > 1) draft.remove(at, 1);
      break;
    case 2:
      std::swap(draft.spheres[at], draft.spheres[other]);
      break;
    default:
      draft.spheres[at] = draft.spheres[other];
  }
}

}  // namespace

Chain mutate(const Chain& chain, Dice& dice, std::uint32_t size) {
  Draft draft = Draft::of(chain);
  if (draft.size() > size) draft.remove(size, draft.size() - size);
  for (std::uint32_t edits = 1 + dice.below(4); edits > 0; --edits) {
    const Draft before = draft;
    const std::uint32_t kind = dice.below(16);
    if (kind == 0)
      change_rule(draft, dice);
    else if (kind < 5)
      edit_spheres(draft, dice, size);
    else
      edit_number(draft, dice);
    if (!draft.finite()) draft = before;
  }
  return std::move(draft).chain();
}

}  // namespace catena::properties
