// lattice, lattice_moved: a tube that fills a cubic lattice, where each sphere touches all six around it
// exactly; and the same with centres moved by an ulp.
#include <cmath>
#include <limits>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/serpentine_path.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

/// Up to `ulps` steps up or down, at random; zero stays, as the ulp of zero is no distance of this lattice.
float moved(float v, std::uint32_t ulps, Random& random) {
  const double range = ulps + 1.0;
  const int steps = static_cast<int>(std::floor(random.unit() * (2 * range - 1))) - static_cast<int>(ulps);
  if (v == 0) return v;
  const float towards = std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(steps));
  for (int k = 0; k < std::abs(steps); ++k) v = std::nextafter(v, towards);
  return v;
}

Row lattice(const SceneSetup& setup, std::uint32_t ulps, const Random& seeded) {
  const std::uint32_t side = side_of_cube(setup.n());
  const double middle = side / 2;
  const auto touching = [=](std::uint32_t i) {
    const auto [x, y, z] = serpentine_cell(i, side);
    return setup.place(setup.spacing() *
                       (Vec3{double(x), double(y), double(z)} - Vec3{middle, middle, middle}));
  };
  if (ulps == 0) return Row::by_number(setup.n(), touching);
  return Row::by_steps(setup.n(), [=] {
    return [=, random = seeded, i = std::uint32_t{0}]() mutable {
      const Sphere s = touching(i++);
      return Sphere{moved(s.x, ulps, random), moved(s.y, ulps, random), moved(s.z, ulps, random), s.radius};
    };
  });
}

SceneRegistry::Make make(const char* name) {
  return [name](const Parameters& parameters) {
    const auto ulps = static_cast<std::uint32_t>(parameters.unsigned_integer("ulps", 0, 1000));
    const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
    return std::make_unique<StillScene>(lattice(SceneSetup(name, parameters), ulps, random));
  };
}

std::vector<ParameterInfo> parameters_with(const char* ulps) {
  return {{"ulps", ulps, "centres are moved by up to so many ulps, at random"},
          {"seed", "1", "of the random moves"},
          {"spacing", "2", "between neighbours along the tube, in radii; 2 makes them touch"},
          {"align", "axes", "axes: whole numbers, touching exactly; general: turned, then rounded"}};
}

const RegisterScene touching{
    {"lattice",
     "tube that fills a cubic lattice; each sphere touches the six around it exactly",
     parameters_with("0"),
     "every contact is an exact tie, in three directions",
     {"align=axes", "align=general", "scale=1e-30", "scale=1e30"}},
    make("lattice")};

const RegisterScene moved_by_one{{"lattice_moved",
                                  "the lattice with its centres moved by an ulp",
                                  parameters_with("1"),
                                  "contacts are missed or made by the last bit of a coordinate, both ways",
                                  {"ulps=1", "ulps=2", "ulps=1,offset=4096"}},
                                 make("lattice_moved")};

}  // namespace
}  // namespace catena
