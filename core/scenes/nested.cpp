// nested: groups of spheres, each inside the next and touching it from within at one common point.
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"

namespace catena {
namespace {

Row nested(const SceneSetup& setup, std::uint32_t together) {
  return Row::by_number(setup.n(), [=](std::uint32_t i) {
    // All of a group touch the plane x = 3 together * group from the right: |c - c'| = |r - r'|, in whole
    // numbers.
    const double size = 1.0 + i % together, wall = 3.0 * together * (i / together);
    return setup.place({wall + size, 0, 0}, size);
  });
}

const RegisterScene registered{
    {"nested",
     "groups of spheres, each inside the next and touching it from within",
     {{"together", "30", "spheres in a group"},
      {"align", "axes", "axes: whole numbers, so the spheres touch exactly; general: turned, then rounded"},
      {"spacing", "1.6", "not used: it is 1 in a group"}},
     "d + r1 = r2 exactly, where the paper's two cases of a parent (<= and <) disagree",
     {"together=2", "together=30", "together=30,align=general"}},
    [](const Parameters& parameters) {
      const auto together = static_cast<std::uint32_t>(parameters.unsigned_integer("together", 1, 1u << 20));
      return std::make_unique<StillScene>(nested(SceneSetup("nested", parameters), together));
    }};

}  // namespace
}  // namespace catena
