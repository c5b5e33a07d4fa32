// walk: a random walk with persistence, the shape of a free polymer: clusters and voids on every scale.
#include "catena/core/scenes/random_walk.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row walk(const SceneSetup& setup, double persistence, const Random& random) {
  const RandomWalk walk(setup.spacing(), persistence, random);
  return Row::by_steps(setup.n(), [=] { return [=, next = walk]() mutable { return setup.place(next()); }; });
}

const RegisterScene registered{
    {"walk",
     "random walk that keeps its direction for a while",
     {{"persistence", "20", "length over which the direction is forgotten, in radii"},
      {"seed", "1", "of the random path"}}},
    [](const Parameters& parameters) {
      const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
      return std::make_unique<StillScene>(
          walk(SceneSetup("walk", parameters), parameters.real("persistence", 0.1, 1e9), random));
    }};

}  // namespace
}  // namespace catena
