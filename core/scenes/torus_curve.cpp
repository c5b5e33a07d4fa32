#include "catena/core/scenes/torus_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catena/core/scenes/turn.h"

namespace catena {
namespace {

constexpr double tau = 2 * std::numbers::pi;

struct Least {
  double at, value;
};

/// The least value of f in [low, high], where it falls and then rises. By thirds: plain arithmetic in a fixed
/// order, so that scenes have the same bits everywhere.
template <class F>
Least least(double low, double high, const F& f) {
  for (int k = 0; k < 90; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (f(a) < f(b))
      high = b;
    else
      low = a;
  }
  const double at = (low + high) / 2;
  return {at, f(at)};
}

}  // namespace

Vec3 TorusCurve::position(double t) const {
  const auto [cos_p, sin_p] = circle_point(p * t);
  const auto [cos_q, sin_q] = circle_point(q * t);
  const double out = core + around * cos_q;
  return {out * cos_p, out * sin_p, around * sin_q};
}

double TorusCurve::speed(double t) const {
  // The two windings move at right angles.
  const double along = tau * p * (core + around * circle_point(q * t).cosine), across = tau * q * around;
  return std::sqrt(along * along + across * across);
}

double TorusCurve::arc_length() const {
  // The trapezoidal rule converges geometrically on a period; the speed has the period 1/q.
  constexpr int samples = 256;
  double sum = 0;
  for (int k = 0; k < samples; ++k) sum += speed(static_cast<double>(k) / samples / q);
  return sum / samples;
}

std::function<double()> TorusCurve::equal_steps(std::uint32_t n) const {
  // The classical Runge-Kutta method for dt/ds = 1/speed(t), in steps short enough that the last point is one
  // step from the first.
  const std::uint32_t substeps = 64 * (p + q) / n + 1;
  const double h = arc_length() / n / substeps;
  return [curve = *this, substeps, h, t = 0.0]() mutable {
    const double here = t;
    for (std::uint32_t k = 0; k < substeps; ++k) {
      const double k1 = 1 / curve.speed(t), k2 = 1 / curve.speed(t + h / 2 * k1),
                   k3 = 1 / curve.speed(t + h / 2 * k2), k4 = 1 / curve.speed(t + h * k3);
      t += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return here;
  };
}

double TorusCurve::closest_windings() const {
  // The winding beside that at t has the same angle around the axis after k/p of the curve, and its angle
  // around the core differs by k q/p = 1/p of a turn.
  std::uint32_t k = 1;
  while (k < p && (std::uint64_t{k} * q) % p != 1 % p) ++k;
  const auto beside = [&](double t) {
    const double middle = t + static_cast<double>(k) / p, reach = 0.4 / (p + q);
    return least(middle - reach, middle + reach,
                 [&](double other) { return length(position(other) - position(t)); })
        .value;
  };
  constexpr int samples = 64;  // over one winding around the core; the others are alike
  double best = 0, smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / samples / q;
    if (const double distance = beside(t); distance < smallest) best = t, smallest = distance;
  }
  const double step = 1.0 / samples / q;
  return std::min(smallest, least(best - step, best + step, beside).value);
}

}  // namespace catena
