// coincident: groups of equal spheres at one place each.
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row coincident(const SceneSetup& setup, std::uint32_t together) {
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    return setup.place({10.0 * (i / together), 0, 0});
  });
}

const RegisterScene registered{
    {"coincident",
     "groups of equal spheres at one place each",
     {{"together", "30", "spheres at one place; n for all of them"},
      {"spacing", "1.6", "not used: it is 0 in a group"}},
     "the direction from a sphere to its equal is 0/0 in the paper's formula, and no split separates a group",
     {"together=2", "together=30"}},
    [](const Parameters& parameters) {
      const auto together = static_cast<std::uint32_t>(parameters.unsigned_integer("together", 1, 1u << 31));
      return std::make_unique<StillScene>(coincident(SceneSetup("coincident", parameters), together));
    }};

}  // namespace
}  // namespace catena
