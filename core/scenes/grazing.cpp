// grazing: a spring whose turns touch along their whole length, by a margin as small as wanted: each sphere
// has one contact, straight above it, and all of them are equally near to changing their mind.
#include <algorithm>
#include <cmath>

#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

Row grazing(const SceneSetup& setup, double margin, std::uint32_t turn) {
  // Sphere i + turn lies straight above sphere i, at the distance `pitch`: pitch^2 = 4 (1 - margin).
  const double pitch = 2 * std::sqrt(1 - margin), rise = pitch / turn;
  const double chord = std::sqrt(std::max(0.0, setup.spacing() * setup.spacing() - rise * rise));
  const double width = chord / (2 * circle_point(0.5 / turn).sine);
  const double middle = (setup.n() - 1.0) / 2;
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    const auto [cosine, sine] = circle_point(static_cast<double>(i % turn) / turn);
    return setup.place({width * cosine, width * sine, rise * (i - middle)});
  });
}

const RegisterScene registered{
    {"grazing",
     "spring whose turns touch along their whole length",
     {{"margin", "1e-6", "of every contact, (t - q) / t; below 0 the turns are apart, at 0 they just touch"},
      {"turn", "40", "spheres in a turn"}},
     "every contact is equally near to changing its mind: below a margin of 1e-7 the stored coordinates "
     "decide, "
     "and rounded arithmetic decides otherwise",
     {"margin=1e-2", "margin=1e-4", "margin=1e-6", "margin=1e-7", "margin=1e-8", "margin=0", "margin=-1e-7"}},
    [](const Parameters& parameters) {
      const auto turn = static_cast<std::uint32_t>(parameters.unsigned_integer("turn", 8, 1u << 20));
      return std::make_unique<StillScene>(
          grazing(SceneSetup("grazing", parameters), parameters.real("margin", -1, 0.5), turn));
    }};

}  // namespace
}  // namespace catena
