#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "catena/bench/knots/judge_knot.h"
#include "catena/core/scenes/vec3.h"
#include "catena/core/strategy/registry.h"
#include "catena/properties/generators/dice.h"

/// The bounds on the first contact, on polygons whose thickness is found here without spheres: by all pairs
/// of edges.
namespace catena::bench {
namespace {

using properties::Dice;

constexpr double pi = std::numbers::pi;

Vec3 centre(const Chain& chain, std::uint32_t i) {
  const Sphere& s = chain[i % chain.size()];
  return {s.x, s.y, s.z};
}

double from_point(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return length(p - a - t * along);
}

/// The distance of two edges: at an end of one, or where both lines are nearest.
double between(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  double least =
      std::min({from_point(a, c, d), from_point(b, c, d), from_point(c, a, b), from_point(d, a, b)});
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
  if (area <= 1e-12 * uu * vv) return least;
  const double s = (uv * dot(v, w) - vv * dot(u, w)) / area, t = (uu * dot(v, w) - uv * dot(u, w)) / area;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least = std::min(least, length(w + s * u - t * v));
  return least;
}

/// Rawdon's thickness, the lesser of the tightest bend and half of where the polygon comes nearest to itself;
/// nothing where that is too near along the polygon to tell from a bend.
std::optional<double> thickness(const Chain& chain) {
  const std::uint32_t n = chain.size();
  const PolygonShape shape = shape_of(chain);
  std::vector<double> at{0};
  for (std::uint32_t i = 0; i < n; ++i)
    at.push_back(at.back() + length(centre(chain, i + 1) - centre(chain, i)));
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j) {
      const double ahead = at[j] - at[i + 1], behind = shape.length - (at[j + 1] - at[i]);
      // Nearer along a polygon of such bends nothing is at right angles to both edges.
      if (std::min(ahead, behind) < 0.8 * pi * shape.tightest_bend) continue;
      nearest = std::min(
          nearest, between(centre(chain, i), centre(chain, i + 1), centre(chain, j), centre(chain, j + 1)));
    }
  if (nearest < 1.8 * shape.tightest_bend) return nearest / 2;
  if (nearest > 2.2 * shape.tightest_bend) return shape.tightest_bend;
  return std::nullopt;
}

/// A closed curve of a few waves, drawn by n vertices that are not quite evenly spaced.
Chain random_curve(Dice& dice, std::uint32_t n) {
  std::array<std::array<double, 6>, 3> waves;
  for (auto& wave : waves)
    for (double& w : wave) w = dice.symmetric();
  const double uneven = dice.one_in(2) ? 0.3 : 0;
  std::vector<Sphere> spheres;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double t = 2 * pi * k / n + uneven * std::sin(2 * pi * k / n);
    std::array<double, 3> p{};
    for (std::size_t m = 0; m < waves.size(); ++m)
      for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] += (waves[m][2 * axis] * std::cos(static_cast<double>(m + 1) * t) +
                    waves[m][2 * axis + 1] * std::sin(static_cast<double>(m + 1) * t)) /
                   static_cast<double>(m + 1);
    spheres.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), 0});
  }
  return Chain(std::move(spheres), Strands::one_closed(n));
}

TEST(KnotBounds, HoldForPolygonsWhoseThicknessAllPairsOfEdgesTell) {
  Dice dice(3);
  double used = 0;  // of the room above the thickness
  int by_contact = 0, by_bend = 0, told_thick = 0, told_thin = 0;
  for (int k = 0; k < 300; ++k) {
    const Chain chain = random_curve(dice, 30 + dice.below(700));
    const auto thick = thickness(chain);
    if (!thick) continue;
    const PolygonShape shape = shape_of(chain);
    const PublishedKnot told{.name = "told", .ropelength = shape.length / *thick, .error = 1e-9};
    const KnotVerdict v = judge_knot(*StrategyRegistry::instance().make("Hybrid"), told, chain, 0);
    EXPECT_EQ(v.fault(), "") << "case " << k << ", " << chain.size() << " vertices";
    const bool contact = *thick < shape.tightest_bend;
    ++(contact ? by_contact : by_bend);
    if (!contact) continue;
    used = std::max(used, (v.first() - *thick) / (v.bounds.most - *thick));
    // What is told twice as thick or as thin is a fault wherever the edges are short enough to tell.
    for (const double share : {0.5, 2.0}) {
      const PublishedKnot wrong{.name = "told", .ropelength = told.ropelength * share, .error = 1e-9};
      const auto w = judge_knot(*StrategyRegistry::instance().make("Hybrid"), wrong, chain, 0);
      if (share < 1 ? w.bounds.least < v.bounds.most : w.bounds.most > v.bounds.least) continue;
      EXPECT_FALSE(w.within()) << "case " << k;
      ++(share < 1 ? told_thick : told_thin);
    }
  }
  EXPECT_GT(by_contact, 40);
  EXPECT_GT(by_bend, 20);
  EXPECT_GT(told_thick, 10);
  EXPECT_GT(told_thin, 10);
  EXPECT_GT(used, 0.5);  // of the room that the edges give, much
}

}  // namespace
}  // namespace catena::bench
