// walk: a random walk with persistence, the shape of a free polymer: clusters and voids on every scale.
#include <cmath>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Chain walk(const SceneSetup& setup, double persistence, Random random) {
  // A heading disturbed by `kick` in a random direction keeps 1 - kick^2 / 3 of itself on average.
  const double kick = std::sqrt(3 * setup.spacing() / persistence);
  std::vector<Sphere> spheres;
  spheres.reserve(setup.n());
  Vec3 centre, heading{1, 0, 0};
  for (std::uint32_t i = 0; i < setup.n(); ++i) {
    spheres.push_back(setup.place(centre));
    const Vec3 disturbed = heading + kick * random.direction();
    const double size = length(disturbed);
    if (size > 1e-9)
      heading = 1 / size * disturbed;  // a kick straight back leaves no direction: keep the old one
    centre = centre + setup.spacing() * heading;
  }
  return Chain(std::move(spheres));
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
