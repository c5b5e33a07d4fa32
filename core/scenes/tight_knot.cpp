// tight_knot: a torus knot drawn so tight that its windings touch where they come nearest to each other.
#include <algorithm>
#include <cmath>

#include "catena/core/chain/bending_window.h"
#include "catena/core/error.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/torus_curve.h"

namespace catena {
namespace {

/// The windings that n spheres at about this spacing fill: the length of such a knot over its radius of
/// contact is close to 6.7 p^2.
TorusCurve filled_by(std::uint32_t n, double spacing) {
  const auto p = static_cast<std::uint32_t>(std::sqrt(n * spacing / 6.7));
  return {std::max(2u, p), std::max(2u, p) + 1};
}

StillScene tight_knot(const SceneSetup& setup, const TorusCurve& knot, double margin) {
  // t = (2r)^2 and q = d^2 at the nearest place: q = t (1 - margin). One length unit of the curve is 1/r
  // radii.
  const double radius = knot.closest_windings() / 2 / std::sqrt(1 - margin);
  const std::uint32_t n = setup.n();
  const auto around = [=] {
    return [=, next = knot.equal_steps(n)] { return setup.place(1 / radius * knot.position(next())); };
  };
  // What a tube of this thickness can bend into lies nearer than pi r along it: not a contact.
  return StillScene(Row::by_steps(n, around), Strands::one_closed(n), Exclusion::arc(bending_window));
}

const RegisterScene registered{
    {"tight_knot",
     "closed torus knot whose windings just touch",
     {{"margin", "0.05", "of the nearest windings, (t - q) / t; below 0 they are apart"},
      {"p", "0", "windings around the axis, and p + 1 around the core; 0: as many as n spheres fill"},
      {"spacing", "0.4", "about, where p is 0; otherwise it follows from p and n"}},
     "windings lie side by side at the distance of contact, over stretches that grow as the margin falls",
     {"margin=0.2", "margin=0.05", "p=2,margin=1e-2", "p=2,margin=1e-4", "p=2,margin=0"}},
    [](const Parameters& parameters) {
      const SceneSetup setup("tight_knot", parameters);
      const auto p = static_cast<std::uint32_t>(parameters.unsigned_integer("p", 0, 1000));
      if (p == 1)
        throw InputError("scene tight_knot: p=1 has no second winding to touch; give 2 or more, or 0");
      const TorusCurve knot = p == 0 ? filled_by(setup.n(), setup.spacing()) : TorusCurve{p, p + 1};
      return std::make_unique<StillScene>(tight_knot(setup, knot, parameters.real("margin", -1, 0.5)));
    }};

}  // namespace
}  // namespace catena
