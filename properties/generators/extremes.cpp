#include <cmath>
#include <limits>

#include "catena/properties/generators/family.h"
#include "catena/properties/generators/shapes.h"

/// The edges of binary32.
namespace catena::properties {
namespace {

using Float = std::numeric_limits<float>;

/// A tangle so small that its numbers, or their squares, are denormal.
Draft denormal(Dice& dice, std::uint32_t size) {
  Draft draft{
      dice.one_in(2) ? integer_walk(dice, 1 + dice.below(size)) : tangle(dice, 1 + dice.below(size)), {}, {}};
  scale(draft.spheres, dice.one_in(3) ? dice.between(-90, -40) : dice.between(-149, -120));
  return draft;
}

/// A tangle far from the origin: rounding there is as large as the spheres.
Draft far(Dice& dice, std::uint32_t size) {
  Draft draft{
      dice.one_in(2) ? integer_walk(dice, 1 + dice.below(size)) : tangle(dice, 1 + dice.below(size)), {}, {}};
  const float x = any_float(dice, 10, 127), y = dice.one_in(2) ? 0 : any_float(dice, 10, 127),
              z = dice.one_in(2) ? x : any_float(dice, 10, 30);
  const float ulp = std::ldexp(1.0f, std::ilogb(x) - 23);
  const bool grow = dice.one_in(2);  // spheres of a few ulp
  for (Sphere& s : draft.spheres) {
    const float f = grow ? ulp : 1;
    const Sphere t{x + f * s.x, y + f * s.y, z + f * s.z, f * s.radius};
    s = {std::isfinite(t.x) ? t.x : Float::max(), std::isfinite(t.y) ? t.y : Float::max(),
         std::isfinite(t.z) ? t.z : Float::max(), std::isfinite(t.radius) ? t.radius : Float::max()};
  }
  return draft;
}

/// Numbers from 2^-149 to 2^128 within one chain: scales up to 1e83 apart.
Draft scales(Dice& dice, std::uint32_t size) {
  Draft draft;
  const int least = dice.pick({-149, -60, -20}), greatest = dice.pick({127, 60, 20});
  for (std::uint32_t n = 1 + dice.below(size); n > 0; --n) {
    const auto number = [&] { return any_float(dice, least, greatest); };
    draft.spheres.push_back({number(), number(), number(), std::fabs(number())});
  }
  return draft;
}

/// Only the special numbers: zeros of both signs, the smallest, the largest, one and its neighbours.
Draft limits(Dice& dice, std::uint32_t size) {
  Draft draft;
  const bool tiny = dice.one_in(3), huge = !tiny && dice.one_in(2);
  const auto special = [&] {
    const float all = dice.pick({0.0f, -0.0f, Float::denorm_min(), Float::min(), 1.0f, 1 + Float::epsilon(),
                                 Float::max(), Float::max() / 2, 0x1p60f, 0x1p-45f, 0x1p-75f});
    const float value =
        tiny   ? dice.pick({0.0f, Float::denorm_min(), 2 * Float::denorm_min(), Float::min(), 0x1p-45f})
        : huge ? dice.pick({0.0f, Float::max(), Float::max() / 2, 0x1p127f, Float::denorm_min()})
               : all;
    return value;
  };
  for (std::uint32_t n = 1 + dice.below(size); n > 0; --n) {
    const auto either = [&] { return dice.one_in(2) ? special() : -special(); };
    draft.spheres.push_back({either(), either(), either(), special()});
  }
  return draft;
}

const RegisterFamily smallest{"denormal", "numbers or squares below the normal range", denormal},
    farthest{"far", "far from the origin, up to the largest float", far},
    mixed{"scales", "scales up to 1e80 apart within one chain", scales},
    special{"limits", "only zeros, smallest, largest and the like", limits};

}  // namespace
}  // namespace catena::properties
