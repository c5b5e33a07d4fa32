// coil: a spring. Far along the tube but near in space: its turns lie side by side without touching.
#include <cmath>
#include <numbers>

#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

Row coil(const SceneSetup& setup, double width, double pitch) {
  const double around = 2 * std::numbers::pi * width;
  const double turns_per_sphere = setup.spacing() / std::sqrt(around * around + pitch * pitch);
  const double middle = (setup.n() - 1.0) / 2;
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    const double turns = turns_per_sphere * (i - middle);
    const auto [cosine, sine] = circle_point(turns);
    return setup.place({width * cosine, width * sine, pitch * turns});
  });
}

const RegisterScene registered{
    {"coil",
     "spring whose turns lie side by side; no pairs unless pitch is near 2, or spacing 1, or less",
     {{"width", "10", "radius of the turns, in radii"},
      {"pitch", "3", "distance of a turn from the next, in radii"}}},
    [](const Parameters& parameters) {
      return std::make_unique<StillScene>(coil(SceneSetup("coil", parameters),
                                               parameters.real("width", 0.1, 1e9),
                                               parameters.real("pitch", 0, 1e9)));
    }};

}  // namespace
}  // namespace catena
