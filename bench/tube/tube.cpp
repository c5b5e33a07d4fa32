#include "catena/bench/tube/tube.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string_view>

#include "catena/bench/tube/arc_length.h"
#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/scenes/torus_curve.h"

namespace catena::bench {
namespace {

constexpr double tau = 2 * std::numbers::pi;

/// A closed tube of radius 1 around a curve on [0, 1] enlarged by `size`.
Tube closed_tube(std::string name, double size, const ArcLength::Curve& point,
                 const ArcLength::Curve& derivative, std::size_t pieces) {
  const auto arc = std::make_shared<ArcLength>(derivative, pieces);
  const double length = size * arc->total();
  return {std::move(name), length, 1, true, [=](double s) { return size * point(arc->parameter(s / size)); }};
}

/// How near the centre line of a helix comes to its next turn: at the angle that Newton's method finds, from
/// straight above on.
double between_turns(double width, double pitch) {
  const double rise = pitch / tau;
  double angle = 0;
  for (int k = 0; k < 20; ++k)
    angle -= (width * width * std::sin(angle) - rise * (pitch - rise * angle)) /
             (width * width * std::cos(angle) + rise * rise);
  return std::hypot(2 * width * std::sin(angle / 2), pitch - rise * angle);
}

}  // namespace

double Tube::apart(double s, double t) const {
  const double ahead = std::abs(s - t);
  return closed ? std::min(ahead, length - ahead) : ahead;
}

Tube straight_rod() {
  return {"straight_rod", 40, 1, false, [](double s) { return Vec3{s - 20, 0, 0}; }};
}

Tube helix(double depth, std::string name) {
  constexpr double width = 6, turns = 10;
  double pitch = 2 - depth;
  for (int k = 0; k < 50; ++k) pitch *= (2 - depth) / between_turns(width, pitch);
  const double around = std::hypot(tau * width, pitch);
  return {std::move(name), turns * around, 1, false, [=](double s) {
            const double turn = s / around;
            return Vec3{width * std::cos(tau * turn), width * std::sin(tau * turn), pitch * turn};
          }};
}

Tube torus_knot(unsigned p, double depth, std::string name) {
  const TorusCurve knot{p, p + 1};
  const double size = (2 - depth) / knot.closest_windings();
  const auto derivative = [=](double t) {
    const double a = tau * knot.p * t, b = tau * knot.q * t,
                 out = TorusCurve::core + TorusCurve::around * std::cos(b);
    const double da = tau * knot.p, db = tau * knot.q, dout = -TorusCurve::around * std::sin(b) * db;
    return Vec3{dout * std::cos(a) - out * std::sin(a) * da, dout * std::sin(a) + out * std::cos(a) * da,
                TorusCurve::around * std::cos(b) * db};
  };
  return closed_tube(
      fmt::format("{}_{}_{}", name, p, p + 1), size, [=](double t) { return knot.position(t); }, derivative,
      64 * (p + 1));
}

Tube lissajous() {
  // x and y swing 3 and 4 times and cross 17 times; z swings so that the heights of the crossings differ.
  const auto point = [](double t) {
    return Vec3{54 * std::cos(tau * 3 * t + 0.3), 54 * std::cos(tau * 4 * t + 0.7),
                2.805 * std::cos(tau * 5 * t + 1.2)};
  };
  const auto derivative = [](double t) {
    return Vec3{-162 * tau * std::sin(tau * 3 * t + 0.3), -216 * tau * std::sin(tau * 4 * t + 0.7),
                -14.025 * tau * std::sin(tau * 5 * t + 1.2)};
  };
  return closed_tube("lissajous", 1, point, derivative, 2000);
}

namespace {

/// A tube takes milliseconds to make, and only those that are asked for are.
struct Known {
  std::string_view name;
  Tube (*make)();
};

constexpr std::array known{
    Known{"straight_rod", straight_rod},
    Known{"helix", [] { return helix(); }},
    Known{"grazing_helix", [] { return helix(1e-5, "grazing_helix"); }},
    Known{"torus_knot_2_3", [] { return torus_knot(); }},
    Known{"tight_torus_knot_2_3", [] { return torus_knot(2, 1e-5, "tight_torus_knot"); }},
    Known{"lissajous", lissajous},
    Known{"path1", path1_tube},
    Known{"path2", path2_tube},
};

}  // namespace

std::vector<std::string> known_tubes() {
  std::vector<std::string> names;
  for (const Known& tube : known) names.emplace_back(tube.name);
  return names;
}

std::vector<Tube> tubes_named(const std::vector<std::string>& names) {
  std::vector<Tube> tubes;
  for (const auto& name : names.empty() ? known_tubes() : names) {
    const auto found = std::ranges::find(known, name, &Known::name);
    if (found == known.end())
      throw InputError(fmt::format("no tube is named '{}'; there are: {}{}", name,
                                   fmt::join(known_tubes(), ", "), did_you_mean(name, known_tubes())));
    tubes.push_back(found->make());
  }
  return tubes;
}

}  // namespace catena::bench
