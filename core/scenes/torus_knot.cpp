// torus_knot: one closed strand that winds p times around the axis of a torus and q times around its core.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "catena/core/error.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/scenes/still.h"
#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

constexpr double core = 1, around = 0.4;  // radii of the torus, before it is scaled to the length of the tube
constexpr double tau = 2 * std::numbers::pi;

struct TorusKnot {
  std::uint32_t p, q;

  /// The point at the fraction t of the closed curve.
  Vec3 position(double t) const {
    const auto [cos_p, sin_p] = circle_point(p * t);
    const auto [cos_q, sin_q] = circle_point(q * t);
    const double out = core + around * cos_q;
    return {out * cos_p, out * sin_p, around * sin_q};
  }
  /// |d position / dt|: the two windings move at right angles.
  double speed(double t) const {
    const double along = tau * p * (core + around * circle_point(q * t).cosine), across = tau * q * around;
    return std::sqrt(along * along + across * across);
  }
  /// Arc length of the whole curve. The trapezoidal rule converges geometrically on a period; the speed has
  /// the period 1/q.
  double arc_length() const {
    constexpr int samples = 256;
    double sum = 0;
    for (int k = 0; k < samples; ++k) sum += speed(static_cast<double>(k) / samples / q);
    return sum / samples;
  }
};

Chain torus_knot(const SceneSetup& setup, const TorusKnot& knot) {
  const std::uint32_t n = setup.n();
  const double whole = knot.arc_length(), size = n * setup.spacing() / whole;
  // Equal arc lengths by the classical Runge-Kutta method for dt/ds = 1/speed(t), in steps short enough that
  // the last sphere is one spacing from the first.
  const std::uint32_t substeps = n == 0 ? 1 : 64 * (knot.p + knot.q) / n + 1;
  const double h = n == 0 ? 0 : whole / n / substeps;
  std::vector<Sphere> spheres;
  spheres.reserve(n);
  double t = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    spheres.push_back(setup.place(size * knot.position(t)));
    for (std::uint32_t k = 0; k < substeps; ++k) {
      const double k1 = 1 / knot.speed(t), k2 = 1 / knot.speed(t + h / 2 * k1),
                   k3 = 1 / knot.speed(t + h / 2 * k2), k4 = 1 / knot.speed(t + h * k3);
      t += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
  return Chain(std::move(spheres), Strands::one_closed(n));
}

TorusKnot knot(const Parameters& parameters) {
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
