// rod: a straight tube. Every parent of two spheres is as tight as can be, so its rounding decides enclosure.
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row rod(const SceneSetup& setup) {
  const double middle = (setup.n() - 1.0) / 2;
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    return setup.place({setup.spacing() * (i - middle), 0, 0});
  });
}

const RegisterScene registered{{"rod", "straight tube; no pairs where spacing is above 1", {}},
                               [](const Parameters& parameters) {
                                 return std::make_unique<StillScene>(rod(SceneSetup("rod", parameters)));
                               }};

}  // namespace
}  // namespace catena
