// largest, smallest, subnormal: one tangle at the ends of what binary32 can store.
#include <algorithm>
#include <cmath>

#include "catena/core/scenes/random_walk.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

/// `exponent` gives the radius as a power of two, from the extent of the tangle in radii.
using Exponent = int (*)(double extent);

Row tangle(const SceneSetup& setup, Exponent exponent, const Random& random) {
  const RandomWalk walk(setup.spacing(), 2, random);
  double extent = 1;
  RandomWalk first = walk;
  for (std::uint32_t i = 0; i < setup.n(); ++i) extent = std::max(extent, length(first()) + 1);
  const double size = std::ldexp(1.0, exponent(extent));
  return Row::by_steps(
      setup.n(), [=] { return [=, next = walk]() mutable { return setup.place(size * next(), size); }; });
}

SceneRegistry::Make at(const char* name, Exponent exponent) {
  return [=](const Parameters& parameters) {
    const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
    return std::make_unique<StillScene>(tangle(SceneSetup(name, parameters), exponent, random));
  };
}

const ParameterInfo seed{"seed", "1", "of the random path"};

const RegisterScene largest{
    {"largest",
     "tangle whose coordinates come near the largest float",
     {seed},
     "every square overflows binary32, and so do differences of two coordinates and sums of two radii"},
    at("largest", [](double extent) { return 126 - std::ilogb(extent); })};

const RegisterScene smallest{
    {"smallest",
     "tangle whose radius is the smallest normal float",
     {seed},
     "every square underflows to zero in binary32: all pairs seem to touch, all distances to vanish"},
    at("smallest", [](double) { return -126; })};

const RegisterScene subnormal{
    {"subnormal",
     "tangle whose radius is four times the smallest subnormal float",
     {seed},
     "coordinates are a coarse lattice of exact ties; hardware that flushes subnormals to zero loses it all"},
    at("subnormal", [](double) { return -147; })};

}  // namespace
}  // namespace catena
