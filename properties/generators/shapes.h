#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/sphere.h"
#include "catena/properties/generators/dice.h"

namespace catena::properties {

/// Steps of about one radius in random directions, so that many spheres collide. Coordinates within +-n.
std::vector<Sphere> tangle(Dice& dice, std::uint32_t n);

/// Unit steps along the axes, radii of 1/2 (or mixed multiples of it): spheres touch exactly, or coincide.
std::vector<Sphere> integer_walk(Dice& dice, std::uint32_t n);

/// A float from anywhere: random sign, exponent in [least, greatest], few or all bits of its significand.
float any_float(Dice& dice, int least = -149, int greatest = 127);

/// The value `steps` floats above (or below) this one; finite, and for a radius never below 0.
float moved_by_ulps(float value, int steps);

/// The same chain with its numbers times 2^exponent, as far as that stays finite: each sphere that would not
/// is left as it is. Small numbers round.
void scale(std::vector<Sphere>& spheres, int exponent);

}  // namespace catena::properties
