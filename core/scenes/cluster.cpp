// cluster: shells of spheres that halve their distance to one point again and again, under one sphere that
// covers them all.
#include <cmath>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Chain cluster(const SceneSetup& setup, std::uint32_t shells, Random random) {
  // Small enough that a shell has room for all its spheres, so that n spheres have about n pairs besides
  // those of the cover.
  const double size = 0.5 / std::sqrt(1.0 + static_cast<double>(setup.n()) / shells);
  std::vector<Sphere> spheres;
  spheres.reserve(setup.n());
  for (std::uint32_t i = 0; i < setup.n(); ++i) {
    if (i == 0) {
      spheres.push_back(setup.place({0, 0, 0}));
      continue;
    }
    const double out = std::ldexp(1.0, -static_cast<int>(i % shells));
    spheres.push_back(setup.place(out * random.direction(), out * size));
  }
  return Chain(std::move(spheres));
}

const RegisterScene registered{
    {"cluster",
     "shells that halve their distance to one point, under one sphere that covers them all",
     {{"shells", "100", "each half as wide as the one before; at most 140 have room in binary32"},
      {"seed", "1", "of the random directions"},
      {"spacing", "1.6", "not used"}},
     "a tree over positions becomes one level deeper with each shell, and the search for the cover has to "
     "keep a "
     "node on its stack for each: fixed stacks overflow",
     {"shells=30", "shells=100", "shells=140"}},
    [](const Parameters& parameters) {
      const auto shells = static_cast<std::uint32_t>(parameters.unsigned_integer("shells", 1, 1000));
      const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
      return std::make_unique<StillScene>(cluster(SceneSetup("cluster", parameters), shells, random));
    }};

}  // namespace
}  // namespace catena
