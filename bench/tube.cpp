#include "catena/bench/tube.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "catena/bench/arc_length.h"
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

}  // namespace

double Tube::apart(double s, double t) const {
  const double ahead = std::abs(s - t);
  return closed ? std::min(ahead, length - ahead) : ahead;
}

Tube straight_rod() {
  return {"straight_rod", 40, 1, false, [](double s) { return Vec3{s - 20, 0, 0}; }};
}

Tube helix(double depth) {
  constexpr double width = 6, turns = 10;
  const double pitch = 2 - depth;
  const double around = std::hypot(tau * width, pitch);
  return {"helix", turns * around, 1, false, [=](double s) {
            const double turn = s / around;
            return Vec3{width * std::cos(tau * turn), width * std::sin(tau * turn), pitch * turn};
          }};
}

Tube torus_knot(unsigned p, double depth) {
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
      fmt::format("torus_knot_{}_{}", p, p + 1), size, [=](double t) { return knot.position(t); }, derivative,
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

std::vector<Tube> known_tubes() { return {straight_rod(), helix(), torus_knot(), lissajous()}; }

}  // namespace catena::bench
