#include "catena/core/hierarchy/enclosing_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "catena/core/rounded_up.h"

namespace catena {
namespace {

struct Vector {
  double x = 0, y = 0, z = 0;
};
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

struct Ball {
  Vector centre;
  double radius = -1;  ///< negative: of nothing
};

Vector from_to(const Sphere& a, const Sphere& b) {
  return {double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
}

/// Up to four spheres that a ball touches from inside, as seen from the first sphere's centre.
struct Support {
  std::array<Ball, 4> balls;
  std::size_t size = 0;
};

/// How far a ball reaches beyond this one; up to 0: not at all.
double beyond(const Ball& ball, const Ball& inner) {
  const Vector d{inner.centre.x - ball.centre.x, inner.centre.y - ball.centre.y,
                 inner.centre.z - ball.centre.z};
  return std::sqrt(dot(d, d)) + inner.radius - ball.radius;
}

/// Solves the symmetric k x k system m v = (p, q), both right-hand sides, by elimination; nothing where it is
/// singular.
bool solve(std::array<std::array<double, 5>, 3>& m, std::size_t k) {
  for (std::size_t c = 0; c < k; ++c) {
    const double pivot = m[c][c];
    if (!(std::fabs(pivot) > 0)) return false;
    for (std::size_t r = 0; r < k; ++r) {
      if (r == c) continue;
      const double part = m[r][c] / pivot;
      for (std::size_t j = c; j < 5; ++j) m[r][j] -= part * m[c][j];
    }
  }
  for (std::size_t r = 0; r < k; ++r) m[r][3] /= m[r][r], m[r][4] /= m[r][r];
  return true;
}

/// The ball through all of the support, its centre in their affine hull: from |x - q_i| = radius - r_i, less
/// the first, q_i x = (|q_i|^2 - (r_i - r_0)^2) / 2 + rho (r_i - r_0) with rho = radius - r_0 = |x|.
std::optional<Ball> through(const Support& support) {
  const Ball& first = support.balls[0];
  const std::size_t k = support.size - 1;
  if (k == 0) return first;
  std::array<Vector, 3> q;
  std::array<std::array<double, 5>, 3> m{};
  for (std::size_t i = 0; i < k; ++i) {
    const Ball& b = support.balls[i + 1];
    q[i] = {b.centre.x - first.centre.x, b.centre.y - first.centre.y, b.centre.z - first.centre.z};
  }
  for (std::size_t i = 0; i < k; ++i) {
    const double more = support.balls[i + 1].radius - first.radius;
    for (std::size_t j = 0; j < k; ++j) m[i][j] = dot(q[i], q[j]);
    m[i][3] = 0.5 * (dot(q[i], q[i]) - more * more);
    m[i][4] = more;
  }
  if (!solve(m, k)) return std::nullopt;
  Vector u, v;  // x = u + rho v
  for (std::size_t i = 0; i < k; ++i) {
    u = {u.x + m[i][3] * q[i].x, u.y + m[i][3] * q[i].y, u.z + m[i][3] * q[i].z};
    v = {v.x + m[i][4] * q[i].x, v.y + m[i][4] * q[i].y, v.z + m[i][4] * q[i].z};
  }
  // |u + rho v| = rho.
  const double a = 1 - dot(v, v), b = dot(u, v), c = dot(u, u), root = b * b + a * c;
  if (!(a > 0) || !(root >= 0)) return std::nullopt;
  const double rho = (b + std::sqrt(root)) / a;
  return Ball{
      {first.centre.x + u.x + rho * v.x, first.centre.y + u.y + rho * v.y, first.centre.z + u.z + rho * v.z},
      rho + first.radius};
}

/// The smallest ball about the support and one more, which it touches: through that one and some of the
/// others.
std::optional<std::pair<Ball, Support>> joined(const Support& support, const Ball& one) {
  constexpr double slack = 1e-12;
  std::optional<std::pair<Ball, Support>> best;
  for (std::uint32_t some = 0; some < 1u << support.size; ++some) {
    Support candidate;
    candidate.balls[candidate.size++] = one;
    for (std::size_t i = 0; i < support.size && candidate.size < 4; ++i)
      if (some >> i & 1) candidate.balls[candidate.size++] = support.balls[i];
    const auto ball = through(candidate);
    if (!ball || !(ball->radius >= 0) || (best && !(ball->radius < best->first.radius))) continue;
    const bool around = std::all_of(support.balls.begin(), support.balls.begin() + support.size,
                                    [&](const Ball& b) { return beyond(*ball, b) <= slack * ball->radius; });
    if (around) best = {*ball, candidate};
  }
  return best;
}

/// The centre of the smallest ball, from the first sphere's, as near as binary64 comes in some passes.
Vector centre_of_smallest(std::span<const Sphere> spheres) {
  constexpr int most_passes = 32;
  constexpr double slack = 1e-9;  // a radius within this is small enough
  const auto seen = [&](const Sphere& s) { return Ball{from_to(spheres.front(), s), s.radius}; };
  Support support{{seen(spheres.front())}, 1};
  Ball ball = support.balls[0];
  for (int pass = 0; pass < most_passes; ++pass) {
    Ball farthest;
    double most = -std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres) {
      const Ball b = seen(s);
      if (const double more = beyond(ball, b); more > most) most = more, farthest = b;
    }
    if (!(most > slack * ball.radius)) break;
    const auto larger = joined(support, farthest);
    if (!larger || !(larger->first.radius > ball.radius)) break;  // rounding has the last word
    ball = larger->first, support = larger->second;
  }
  return ball.centre;
}

}  // namespace

Sphere enclosing_ball(std::span<const Sphere> spheres) {
  constexpr double slack = 1 + 0x1p-48;  // as parent_binary64_slack
  const Sphere& first = spheres.front();
  const Vector centre = spheres.size() == 1 ? Vector{} : centre_of_smallest(spheres);
  Sphere ball{static_cast<float>(first.x + centre.x), static_cast<float>(first.y + centre.y),
              static_cast<float>(first.z + centre.z), 0};
  if (!(std::isfinite(ball.x) && std::isfinite(ball.y) && std::isfinite(ball.z)))
    ball = {first.x, first.y, first.z, 0};
  for (const Sphere& s : spheres) {
    const Vector d = from_to(ball, s);
    ball.radius = std::max(ball.radius, rounded_up((std::sqrt(dot(d, d)) + s.radius) * slack));
  }
  return ball;
}

}  // namespace catena
