#include "catena/bench/knots/polygon_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "catena/core/error.h"
#include "catena/core/scenes/step_between.h"

namespace catena::bench {
namespace {

double angle(const Vec3& a, const Vec3& b) {
  const Vec3 across{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return std::atan2(length(across), dot(a, b));
}

/// The radius of the arc in a corner whose nearer edge is so long.
double bend(double edge, double turn) {
  if (turn <= 0) return std::numeric_limits<double>::infinity();
  return turn < std::numbers::pi ? std::max(0.0, edge) / (2 * std::tan(turn / 2)) : 0;
}

void add_corner(PolygonShape& shape, const Vec3& before, const Vec3& after, double blur) {
  const double turn = angle(before, after), edge = std::min(length(before), length(after));
  // Ends that move by the blur turn an edge by at most asin(2 blur / edge), which is below 4 blur / edge.
  const double more = 4 * blur / length(before) + 4 * blur / length(after);
  shape.tightest_bend = std::min(shape.tightest_bend, bend(edge, turn));
  shape.least_bend = std::min(shape.least_bend, bend(edge - 2 * blur, turn + more));
  shape.greatest_bend = std::min(shape.greatest_bend, bend(edge + 2 * blur, turn - more));
}

void add_strand(PolygonShape& shape, std::span<const Sphere> vertices, std::size_t strand, double blur) {
  if (vertices.size() < 3)
    throw InputError(
        fmt::format("strand {} has fewer than three vertices; a knot is a closed polygon", strand));
  Vec3 before = step_between(vertices.back(), vertices.front());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 after = step_between(vertices[i], vertices[(i + 1) % vertices.size()]);
    const double edge = length(after);
    if (!(edge > 0)) throw InputError(fmt::format("strand {}: vertex {} lies on the next one", strand, i));
    shape.length += edge;
    shape.shortest_edge = std::min(shape.shortest_edge, edge);
    shape.longest_edge = std::max(shape.longest_edge, edge);
    add_corner(shape, before, after, blur);
    before = after;
  }
}

}  // namespace

PolygonShape shape_of(const Chain& chain, double blur) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PolygonShape shape{0, infinity, 0, infinity, infinity, infinity};
  const Strands& strands = chain.strands();
  if (chain.size() == 0) throw InputError("there is no vertex; a knot is a closed polygon");
  for (std::size_t s = 0; s + 1 < strands.first.size(); ++s) {
    if (s >= strands.closed.size() || !strands.closed[s])
      throw InputError(
          fmt::format("strand {} is open; a knot is closed: say --closed where the file cannot", s));
    add_strand(shape, chain.spheres().subspan(strands.first[s], strands.first[s + 1] - strands.first[s]), s,
               blur);
  }
  return shape;
}

}  // namespace catena::bench
