// cluster: shells of spheres that halve their distance to one point again and again, under one sphere that
// covers them all.
#include <algorithm>
#include <cmath>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

Row cluster(const SceneSetup& setup, std::uint32_t shells, const Random& seeded) {
  // Each shell is a spiral from pole to pole, so that neighbours along the tube are near each other and the
  // cost of a search in chain order stays near n log n.
  const double in_shell = std::max(1.0, (setup.n() - 1.0) / shells), turns = std::sqrt(in_shell) / 2;
  const double size = std::min(0.25, 2 / std::sqrt(in_shell));  // neighbours touch, shells do not
  return Row::by_steps(setup.n(), [=] {
    return [=, random = seeded, shell_before = shells, start = 0.0, i = std::uint32_t{0}]() mutable {
      if (i++ == 0) return setup.place({0, 0, 0});
      const std::uint64_t k = std::uint64_t{i - 2} * shells;
      const auto shell = static_cast<std::uint32_t>(k / (setup.n() - 1));
      if (shell != shell_before) start = random.unit(), shell_before = shell;
      const double along =
          static_cast<double>(k % (setup.n() - 1)) / (setup.n() - 1.0);  // 0 to 1 in the shell
      const double z = 2 * along - 1, out = std::sqrt(1 - z * z),
                   away = std::ldexp(1.0, -static_cast<int>(shell));
      const auto [cosine, sine] = circle_point(start + turns * along);
      return setup.place(away * Vec3{out * cosine, out * sine, z}, away * size);
    };
  });
}

const RegisterScene registered{
    {"cluster",
     "shells that halve their distance to one point, under one sphere that covers them all",
     {{"shells", "100", "each half as wide as the one before; at most 140 have room in binary32"},
      {"seed", "1", "of the random turn of each shell"},
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
