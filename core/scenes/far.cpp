// far: a tangle far from the origin, where the stored coordinates are coarse: at 2^24 radii they are a
// lattice as wide as a sphere.
#include <cmath>

#include "catena/core/scenes/random_walk.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row far(const SceneSetup& setup, std::uint32_t exponent, const Random& random) {
  const double away = std::ldexp(1.0, static_cast<int>(exponent));
  const RandomWalk walk(setup.spacing(), 2, random);
  return Row::by_steps(setup.n(), [=] {
    return [=, next = walk]() mutable { return setup.place(Vec3{away, away, away} + next()); };
  });
}

const RegisterScene registered{
    {"far",
     "tangle far from the origin",
     {{"exponent", "20",
       "log2 of each coordinate of the origin of the tangle, in radii, before it is turned"},
      {"seed", "1", "of the random path"}},
     "a parent's centre is rounded by more than the radii it must cover, and coarse coordinates make exact "
     "ties",
     {"exponent=10", "exponent=16", "exponent=20", "exponent=22", "exponent=24", "exponent=20,radius=1e24"}},
    [](const Parameters& parameters) {
      const auto exponent = static_cast<std::uint32_t>(parameters.unsigned_integer("exponent", 0, 120));
      const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
      return std::make_unique<StillScene>(far(SceneSetup("far", parameters), exponent, random));
    }};

}  // namespace
}  // namespace catena
