// slender: a straight rod, up to 10^8 radii long. Above 2^24 radii the stored coordinates are coarser than
// the rod is thick, and every parent is as tight as can be around two touching or distant spheres.
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row slender(const SceneSetup& setup, double slenderness) {
  const double middle = (setup.n() - 1.0) / 2;
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    return setup.place({slenderness * ((i - middle) / setup.n()), 0, 0});
  });
}

const RegisterScene registered{
    {"slender",
     "straight rod of a given length over radius",
     {{"slenderness", "1000", "length of the rod, in radii; n spheres share it"},
      {"spacing", "1.6", "not used: it is slenderness / n"}},
     "spheres k apart touch exactly where k slenderness / n = 2, so rounding alone decides them; coordinates "
     "outgrow the radius",
     {"slenderness=1e3", "slenderness=1e4", "slenderness=1e6", "slenderness=1e8"}},
    [](const Parameters& parameters) {
      return std::make_unique<StillScene>(
          slender(SceneSetup("slender", parameters), parameters.real("slenderness", 1e-3, 1e12)));
    }};

}  // namespace
}  // namespace catena
