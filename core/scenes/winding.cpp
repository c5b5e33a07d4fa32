// winding: wire wound so tightly on a spool that its turns go through each other: every sphere has hundreds
// of contacts, whatever n.
#include <numbers>

#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

Row winding(const SceneSetup& setup, double width, double contacts) {
  // On the unrolled spool a disc of radius 2 holds 4 pi / (spacing pitch) centres.
  const double pitch = 4 * std::numbers::pi / (setup.spacing() * contacts);
  const double turns_a_sphere = setup.spacing() / (2 * std::numbers::pi * width);
  const double middle = (setup.n() - 1.0) / 2;
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    const double turns = turns_a_sphere * (i - middle);
    const auto [cosine, sine] = circle_point(turns);
    return setup.place({width * cosine, width * sine, pitch * turns});
  });
}

const RegisterScene registered{
    {"winding",
     "spool wound so tightly that every sphere has hundreds of contacts",
     {{"contacts", "200", "of a sphere, about; fewer near the ends"},
      {"width", "4", "radius of the spool, in radii"}},
     "pairs outnumber spheres a hundredfold: fixed buffers overflow, and pairs of every margin occur",
     {"contacts=20", "contacts=200"}},
    [](const Parameters& parameters) {
      return std::make_unique<StillScene>(winding(SceneSetup("winding", parameters),
                                                  parameters.real("width", 1, 1e9),
                                                  parameters.real("contacts", 1, 1e6)));
    }};

}  // namespace
}  // namespace catena
