// collinear: spheres on an axis at whole distances: sphere i touches sphere i + 2 exactly.
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row collinear(const SceneSetup& setup) {
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    return setup.place({setup.spacing() * (i - static_cast<double>(setup.n() / 2)), 0, 0});
  });
}

const RegisterScene registered{
    {"collinear",
     "spheres on an axis, each touching the next but one exactly",
     {{"spacing", "1", "between neighbours along the tube, in radii; 1 makes i and i + 2 touch"},
      {"align", "axes", "axes: whole numbers, touching exactly; general: turned, then rounded"}},
     "every contact is an exact tie; two of the three differences are zero; parents touch their children",
     {"spacing=1", "spacing=0.5", "spacing=1,align=general"}},
    [](const Parameters& parameters) {
      return std::make_unique<StillScene>(collinear(SceneSetup("collinear", parameters)));
    }};

}  // namespace
}  // namespace catena
