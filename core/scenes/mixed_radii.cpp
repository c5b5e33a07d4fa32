// mixed_radii: a horn whose radii grow by a large factor from end to end, and every other sphere of which is
// a speck beside its neighbours.
#include <cmath>

#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

/// About 2^e: exact for whole e, linear between, so that it has the same bits with every C library.
double near_power_of_two(double e) {
  const double whole = std::floor(e);
  return std::ldexp(1 + (e - whole), static_cast<int>(whole));
}

Row mixed_radii(const SceneSetup& setup, double decades, double jump) {
  constexpr double bits_a_decade = 3.3219280948873623;
  const double octaves = decades * bits_a_decade;
  return Row::by_steps(setup.n(), [=] {
    return [=, x = 0.0, i = std::uint32_t{0}]() mutable {
      const double size = near_power_of_two(octaves * ((i + 0.5) / setup.n() - 0.5));
      const Sphere here = setup.place({x, 0, 0}, i % 2 == 0 ? size : size / jump);
      x += setup.spacing() / 2 * size;  // every second sphere is thick: those touch their like
      ++i;
      return here;
    };
  });
}

const RegisterScene registered{{"mixed_radii",
                                "horn with radii of mixed scale, every other sphere a speck",
                                {{"decades", "30", "log10 of the last radius over the first"},
                                 {"jump", "1e6", "radius of a sphere over that of its neighbour"}},
                                "a speck is absorbed when it is added to what is near it, squares of the "
                                "small end underflow beside those of "
                                "the large end, and a grid has no good cell",
                                {"decades=0", "decades=6", "decades=30", "decades=60,jump=1e12"}},
                               [](const Parameters& parameters) {
                                 return std::make_unique<StillScene>(mixed_radii(
                                     SceneSetup("mixed_radii", parameters), parameters.real("decades", 0, 75),
                                     parameters.real("jump", 1, 1e30)));
                               }};

}  // namespace
}  // namespace catena
