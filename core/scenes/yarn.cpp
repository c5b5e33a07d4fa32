// yarn: a ball of yarn, dense with collisions: about 5 pairs a sphere whatever n.
#include <algorithm>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

// Spheres in a ball per cube of its radius. Found by counting: 4 to 6 pairs a sphere for n from 10,000 to
// 1,000,000 at the default spacing.
constexpr double density = 1.17;
constexpr double skin = 8;          // depth, in radii, over which the yarn is turned back at the surface
constexpr double sharpest = 0.125;  // greatest curvature, per radius

/// Of v > 0, by Newton's method from above until rounding stops the descent: std::cbrt differs between C
/// libraries.
double cube_root(double v) {
  double x = std::max(1.0, v);
  for (;;) {
    const double next = (2 * x + v / (x * x)) / 3;
    if (!(next < x)) return x;
    x = next;
  }
}

Row yarn(const SceneSetup& setup, const Random& seeded) {
  const double ball = cube_root(std::max(1u, setup.n()) / density), inner = std::max(ball - skin, ball / 4);
  const double sharpest_step = sharpest * setup.spacing();
  return Row::by_steps(setup.n(), [=] {
    return [=, random = seeded, centre = Vec3{}, heading = Vec3{1, 0, 0}, drift = Vec3{}]() mutable {
      const Sphere here = setup.place(centre);
      drift = 0.93 * drift + 0.175 * sharpest_step * random.cube();
      Vec3 bend = drift;
      const double out = length(centre);
      if (out > inner) {
        // Turn back: bend sideways, towards the centre. A pull along the heading would bend nothing.
        const Vec3 inward = -1 / out * centre;
        const Vec3 sideways = inward - dot(inward, heading) * heading;
        const double size = length(sideways);
        if (size > 1e-9)
          bend = bend + 1.5 * sharpest_step * std::min(1.0, (out - inner) / 4) / size * sideways;
      }
      const double sharpness = length(bend);
      if (sharpness > sharpest_step) bend = sharpest_step / sharpness * bend;
      heading = heading + bend;
      heading = 1 / length(heading) * heading;
      centre = centre + setup.spacing() * heading;
      return here;
    };
  });
}

const RegisterScene registered{
    {"yarn", "ball of yarn; about 5 pairs a sphere", {{"seed", "1", "of the random path"}}},
    [](const Parameters& parameters) {
      const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
      return std::make_unique<StillScene>(yarn(SceneSetup("yarn", parameters), random));
    }};

}  // namespace
}  // namespace catena
