// points: a walk on a cubic lattice in which some spheres have no extent at all. Two of those collide only
// when they are at one place.
#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Vec3 lattice_step(Random& random) {
  const double which = random.unit() * 6;
  const double way = which < 3 ? 1 : -1;
  const int axis = static_cast<int>(which) % 3;
  return {axis == 0 ? way : 0, axis == 1 ? way : 0, axis == 2 ? way : 0};
}

Row points(const SceneSetup& setup, double share, const Random& seeded) {
  return Row::by_steps(setup.n(), [=] {
    return [=, random = seeded, centre = Vec3{}]() mutable {
      const double size = random.unit() < share ? 0 : 1;
      const Sphere here = setup.place(setup.spacing() * centre, size);
      centre = centre + lattice_step(random);
      return here;
    };
  });
}

const RegisterScene registered{
    {"points",
     "walk on a cubic lattice; some spheres have radius 0",
     {{"share", "0.7", "of spheres with radius 0"},
      {"seed", "1", "of the random path"},
      {"spacing", "1", "between neighbours along the tube, in radii; 1 makes a point and a sphere touch"},
      {"align", "axes", "axes: whole numbers, touching exactly; general: turned, then rounded"}},
     "t = 0 for two points, so no relative slack helps; equal points make 0/0; a point touches a sphere "
     "exactly",
     {"share=0.7", "share=1", "share=1,align=general", "share=0.7,scale=1e-44"}},
    [](const Parameters& parameters) {
      const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
      return std::make_unique<StillScene>(
          points(SceneSetup("points", parameters), parameters.real("share", 0, 1), random));
    }};

}  // namespace
}  // namespace catena
