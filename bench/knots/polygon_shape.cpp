#include "catena/bench/knots/polygon_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catena/core/error.h"
#include "catena/core/scenes/vec3.h"

namespace catena::bench {
namespace {

Vec3 edge_from(const Sphere& a, const Sphere& b) {
  return {double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
}

/// The radius of the arc in the corner between two edges that may turn by as much as `less` under what is seen.
double bend(const Vec3& before, const Vec3& after, double less) {
  const Vec3 across{before.y * after.z - before.z * after.y, before.z * after.x - before.x * after.z,
                    before.x * after.y - before.y * after.x};
  const double turn = std::atan2(length(across), dot(before, after)) - less;
  if (turn <= 0) return std::numeric_limits<double>::infinity();
  return std::min(length(before), length(after)) / (2 * std::tan(turn / 2));
}

void add_strand(PolygonShape& shape, std::span<const Sphere> vertices, std::size_t strand, double blur) {
  if (vertices.size() < 3)
    throw InputError(fmt::format("strand {} has fewer than three vertices; a knot is a closed polygon", strand));
  Vec3 before = edge_from(vertices.back(), vertices.front());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 after = edge_from(vertices[i], vertices[(i + 1) % vertices.size()]);
    const double edge = length(after);
    if (!(edge > 0))
      throw InputError(fmt::format("strand {}: vertex {} lies on the next one", strand, i));
    shape.length += edge;
    shape.shortest_edge = std::min(shape.shortest_edge, edge);
    shape.longest_edge = std::max(shape.longest_edge, edge);
    // Ends that move by the blur turn an edge by at most asin(2 blur / edge), below 4 blur / edge where that is 2.
    const double less = 4 * blur / edge + 4 * blur / length(before);
    shape.tightest_bend = std::min(shape.tightest_bend, bend(before, after, less));
    before = after;
  }
}

}  // namespace

PolygonShape shape_of(const Chain& chain, double blur) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PolygonShape shape{0, infinity, 0, infinity};
  const Strands& strands = chain.strands();
  if (chain.size() == 0) throw InputError("there is no vertex; a knot is a closed polygon");
  for (std::size_t s = 0; s + 1 < strands.first.size(); ++s) {
    if (s >= strands.closed.size() || !strands.closed[s])
      throw InputError(fmt::format("strand {} is open; a knot is closed: say --closed where the file cannot", s));
    add_strand(shape, chain.spheres().subspan(strands.first[s], strands.first[s + 1] - strands.first[s]), s, blur);
  }
  return shape;
}

}  // namespace catena::bench
