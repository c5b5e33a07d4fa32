// hair: a bundle of many strands side by side, each wandering about its own root.
#include <cmath>

#include "catena/core/scenes/random.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

/// Root s of a bundle: a sunflower, about `gap` radii from root to root.
Vec3 root(std::uint32_t s, double gap) {
  constexpr double golden = 0.61803398874989485;  // of a turn
  const auto [cosine, sine] = circle_point(s * golden);
  const double out = 0.56 * gap * std::sqrt(s + 0.5);  // each root has the area of a disc of 0.56 gap
  return {out * cosine, out * sine, 0};
}

StillScene hair(const SceneSetup& setup, std::uint32_t strands, double gap, const Random& seeded) {
  const std::uint64_t n = setup.n();
  Strands layout{{0}, {}};
  for (std::uint64_t s = 1; s <= strands; ++s)
    layout.first.push_back(static_cast<std::uint32_t>(n * s / strands));
  const double fade = 1 / (1 + 0.05 * setup.spacing());  // a hair forgets its lean over 20 radii
  const double half_height = setup.spacing() * (n / strands) / 2;
  const auto from_the_first_root = [=, first = layout.first] {
    return [=, random = seeded, i = std::uint32_t{0}, s = std::uint32_t{0}, start = Vec3{}, centre = Vec3{},
            lean = Vec3{}]() mutable {
      if (i == first[s]) {
        while (first[s + 1] == i) ++s;  // without spheres
        start = root(s++, gap);
        centre = start - Vec3{0, 0, half_height}, lean = {};
      }
      const Sphere here = setup.place(centre);
      const Vec3 astray{centre.x - start.x, centre.y - start.y, 0};
      const Vec3 gust = random.cube();
      lean =
          fade * lean + 0.06 * setup.spacing() * Vec3{gust.x, gust.y, 0} - 0.001 * setup.spacing() * astray;
      const Vec3 heading = lean + Vec3{0, 0, 1};
      centre = centre + setup.spacing() / length(heading) * heading;
      ++i;
      return here;
    };
  };
  return StillScene(Row::by_steps(setup.n(), from_the_first_root), std::move(layout));
}

const RegisterScene registered{
    {"hair",
     "bundle of many open strands",
     {{"strands", "100", "number of strands; spheres are shared out evenly"},
      {"gap", "3", "distance of the roots, in radii"},
      {"seed", "1", "of the random strands"}}},
    [](const Parameters& parameters) {
      const Random random(parameters.unsigned_integer("seed", 0, ~std::uint64_t{0}));
      const auto strands = static_cast<std::uint32_t>(parameters.unsigned_integer("strands", 1, 1u << 20));
      return std::make_unique<StillScene>(
          hair(SceneSetup("hair", parameters), strands, parameters.real("gap", 0, 1e9), random));
    }};

}  // namespace
}  // namespace catena
