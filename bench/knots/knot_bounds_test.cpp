#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "catena/bench/knots/judge_knot.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/vec3.h"
#include "catena/properties/generators/dice.h"

/// The bounds on the first contact, on polygons whose thickness is found here without spheres: by all pairs
/// of edges.
namespace catena::bench {
namespace {

using properties::Dice;

using std::numbers::pi;

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

/// A polygon of which no more is known.
PolygonShape shape_like(double length, double shortest, double longest) {
  PolygonShape shape{length, shortest, longest};
  shape.tightest_bend = shape.least_bend = shape.greatest_bend = 1;
  return shape;
}

TEST(KnotBounds, AreTheRootsThatTheirDefinitionSays) {
  for (const double edge : {0.01, 0.1, 0.3, 0.6}) {
    const PolygonShape shape = shape_like(40, edge, edge);
    const KnotBounds polygon = bounds_of({.thickness = 1.25}, shape, 0);
    const double thick = 1.25, h = edge / 2 / thick, dip = thick * (std::sqrt(1 + h * h) - 1),
                 c = std::atan(h) / h, k = std::asin(h), r = polygon.least;
    EXPECT_NEAR(r, thick * std::sin(pi * c * r / 2 / thick) - dip, 1e-11) << edge;
    EXPECT_LT(r, thick) << edge;
    EXPECT_NEAR(polygon.most, thick * std::sqrt(1 + h * h / 2), 1e-12) << edge;
    EXPECT_EQ(polygon.least_bend, thick) << edge;
    const KnotBounds curve = bounds_of({.of = PublishedKnot::Of::curve, .thickness = thick}, shape, 0);
    EXPECT_EQ(curve.least, thick);
    EXPECT_NEAR(curve.most, thick * k / h * (std::sqrt(1 + k * k) + k * k / 2), 1e-12) << edge;
    const KnotBounds type = bounds_of({.of = PublishedKnot::Of::type, .thickness = thick}, shape, 0);
    EXPECT_EQ(type.least, 0);
    EXPECT_NEAR(type.most, thick * std::sqrt((1 + h * h) * (1 + h * h / 2)), 1e-12) << edge;
  }
  const KnotBounds none = bounds_of({.of = PublishedKnot::Of::curve, .thickness = 1}, shape_like(9, 3, 3), 0);
  EXPECT_EQ(none.most, std::numeric_limits<double>::infinity()) << "an edge longer than the tube is thick";
  // Of the bounds that edges do not let be told the lower one is nothing, not something.
  EXPECT_EQ(bounds_of({.thickness = 1}, shape_like(9, 3, 3), 0).least, 0);
  // A curve may bend as its shortest edge lets it, by the angle that its longest one may turn.
  const KnotBounds uneven =
      bounds_of({.of = PublishedKnot::Of::curve, .thickness = 1.25}, shape_like(40, 0.25, 0.5), 0);
  EXPECT_NEAR(uneven.least_bend, 0.25 / (2 * std::tan(std::asin(0.5 / 2.5))), 1e-12);
}

/// What holds for any number within the error, and for any vertices within the blur, holds for what is told.
TEST(KnotBounds, HoldForEveryNumberWithinItsErrorAndWidenByTheBlur) {
  const PolygonShape shape = shape_like(40, 0.25, 0.375);
  for (const auto of : {PublishedKnot::Of::polygon, PublishedKnot::Of::curve, PublishedKnot::Of::type})
    for (const double error : {1e-3, 0.5}) {
      const KnotBounds told = bounds_of({.of = of, .ropelength = 32, .error = error}, shape, 0);
      const KnotBounds thick = bounds_of({.of = of, .thickness = 1.25, .error = error / 32}, shape, 0);
      for (const double off : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const KnotBounds one = bounds_of({.of = of, .ropelength = 32 + off * error}, shape, 0);
        EXPECT_LE(told.least, one.least + 1e-11) << off;
        EXPECT_GE(told.most, one.most - 1e-11) << off;
        EXPECT_LE(told.least_bend, one.least_bend + 1e-11) << off;
        const KnotBounds other = bounds_of({.of = of, .thickness = 1.25 + off * error / 32}, shape, 0);
        EXPECT_LE(thick.least, other.least + 1e-11) << off;
        EXPECT_GE(thick.most, other.most - 1e-11) << off;
        EXPECT_LE(thick.least_bend, other.least_bend + 1e-11) << off;
      }
      constexpr double blur = 1e-3, whole = 2 * blur / 0.25;  // of a length that is made of shortest edges
      const KnotBounds blurred = bounds_of({.of = of, .ropelength = 32, .error = error}, shape, blur);
      EXPECT_NEAR(blurred.least, std::max(0.0, told.least * (1 - whole) - 2 * blur), 1e-11);
      EXPECT_NEAR(blurred.most, told.most * (1 + whole) + 2 * blur, 1e-11);
      EXPECT_NEAR(blurred.least_bend, told.least_bend * (1 - whole), 1e-11);
    }
}

/// At the sharpest corner the edge before it is the shorter one, or the one after it, as one goes around.
TEST(PolygonShape, BendsByTheShorterEdgeOnWhicheverSideItIs) {
  std::vector<Sphere> spheres{{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 4, 0, 0}, {-6, 0.5f, 0, 0}};
  const double sharpest = pi - std::atan(4);  // at the second
  for (const bool backwards : {false, true}) {
    const PolygonShape shape = shape_of(Chain(spheres, Strands::one_closed(4)));
    EXPECT_NEAR(shape.tightest_bend, 1 / (2 * std::tan(sharpest / 2)), 1e-12) << backwards;
    std::ranges::reverse(spheres);
  }
}

/// A square's corner is the arc of its shorter edge; what its vertices may be wrong by is told both ways.
TEST(PolygonShape, BendsByTheShorterEdgeAndAsFarAsItsBlurAllows) {
  const Chain rectangle({{0, 0, 0, 0}, {1, 0, 0, 0}, {1, 3, 0, 0}, {0, 3, 0, 0}}, Strands::one_closed(4));
  const auto bend = [](double edge, double turn) { return edge / 2 / std::tan(turn / 2); };
  constexpr double blur = 0.01, more = 4 * blur / 1 + 4 * blur / 3;
  const PolygonShape shape = shape_of(rectangle, blur);
  EXPECT_EQ(shape.shortest_edge, 1);
  EXPECT_EQ(shape.longest_edge, 3);
  EXPECT_NEAR(shape.tightest_bend, bend(1, pi / 2), 1e-12);
  EXPECT_NEAR(shape.least_bend, bend(1 - 2 * blur, pi / 2 + more), 1e-12);
  EXPECT_NEAR(shape.greatest_bend, bend(1 + 2 * blur, pi / 2 - more), 1e-12);
  // Whatever vertices there are within the blur, they bend no more and no less.
  Dice dice(9);
  for (int k = 0; k < 300; ++k) {
    std::vector<Sphere> spheres(rectangle.spheres().begin(), rectangle.spheres().end());
    for (Sphere& s : spheres) {
      const Vec3 off{dice.symmetric(), dice.symmetric(), dice.symmetric()};
      const double share = 0.99 * blur / std::max(length(off), 1e-3);
      s.x += static_cast<float>(share * off.x), s.y += static_cast<float>(share * off.y);
      s.z += static_cast<float>(share * off.z);
    }
    const double moved = shape_of(rectangle.moved(spheres)).tightest_bend;
    EXPECT_LE(shape.least_bend, moved);
    EXPECT_GE(shape.greatest_bend, moved);
  }
}

}  // namespace
}  // namespace catena::bench
