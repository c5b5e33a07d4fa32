// stretched: a tangle whose spheres stand at very unequal distances: gaps, where tubes pass unseen, beside
// heaps.
#include <cmath>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row stretched(const SceneSetup& setup, double octaves, const Random& seeded) {
  return Row::by_steps(setup.n(), [=] {
    return [=, random = seeded, centre = Vec3{}]() mutable {
      const Sphere here = setup.place(centre);
      const double e = octaves * random.symmetric(), whole = std::floor(e);
      const double stretch = std::ldexp(1 + (e - whole), static_cast<int>(whole));
      centre = centre + setup.spacing() * stretch * random.direction();
      return here;
    };
  });
}

const RegisterScene registered{
    {"stretched",
     "tangle with gaps and heaps: very unequal distances along the tube",
     {{"octaves", "3", "distances lie between 2^-octaves and 2^octaves spacings"},
      {"seed", "1", "of the random path"}},
     "parents of far spheres are mostly empty, so the search visits many nodes for few pairs",
     {"octaves=1", "octaves=3", "octaves=12"}},
    [](const Parameters& parameters) {
      const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
      return std::make_unique<StillScene>(
          stretched(SceneSetup("stretched", parameters), parameters.real("octaves", 0, 60), random));
    }};

}  // namespace
}  // namespace catena
