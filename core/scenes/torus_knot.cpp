// torus_knot: one closed strand that winds p times around the axis of a torus and q times around its core.
#include <fmt/format.h>

#include <numeric>

#include "catena/core/error.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/torus_curve.h"

namespace catena {
namespace {

StillScene torus_knot(const SceneSetup& setup, const TorusCurve& knot) {
  const std::uint32_t n = setup.n();
  const double size = n * setup.spacing() / knot.arc_length();
  const auto around = [=] {
    return [=, next = knot.equal_steps(n)] { return setup.place(size * knot.position(next())); };
  };
  return StillScene(Row::by_steps(n, around), Strands::one_closed(n));
}

TorusCurve knot(const Parameters& parameters) {
  const auto p = static_cast<std::uint32_t>(parameters.unsigned_integer("p", 1, 1000));
  const auto q = static_cast<std::uint32_t>(parameters.unsigned_integer("q", 1, 1000));
  if (std::gcd(p, q) != 1)
    throw InputError(fmt::format(
        "scene torus_knot: p={} and q={} must have no common divisor, or it is several strands", p, q));
  return {p, q};
}

const RegisterScene registered{
    {"torus_knot",
     "closed knot on a torus",
     {{"p", "2", "windings around the axis of the torus"},
      {"q", "3", "windings around its core; coprime to p"}}},
    [](const Parameters& parameters) {
      return std::make_unique<StillScene>(torus_knot(SceneSetup("torus_knot", parameters), knot(parameters)));
    }};

}  // namespace
}  // namespace catena
