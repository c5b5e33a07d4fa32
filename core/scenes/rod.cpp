// rod: a straight tube. Every parent of two spheres is as tight as can be, so its rounding decides enclosure.
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Chain rod(const SceneSetup& setup) {
  std::vector<Sphere> spheres;
  spheres.reserve(setup.n());
  const double middle = (setup.n() - 1.0) / 2;
  for (std::uint32_t i = 0; i < setup.n(); ++i)
    spheres.push_back(setup.place({setup.spacing() * (i - middle), 0, 0}));
  return Chain(std::move(spheres));
}

const RegisterScene registered{{"rod", "straight tube; no pairs", {}}, [](const Parameters& parameters) {
                                 return std::make_unique<StillScene>(rod(SceneSetup("rod", parameters)));
                               }};

}  // namespace
}  // namespace catena
