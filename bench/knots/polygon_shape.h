#pragma once
#include "catena/core/chain/chain.h"

namespace catena::bench {

/// The closed polygons whose vertices are the centres of a chain, by binary64.
struct PolygonShape {
  double length = 0;  ///< of all strands
  double shortest_edge = 0, longest_edge = 0;
  /// Rawdon's MinRad: at a vertex where the polygon turns by t, the radius of the arc that touches both edges
  /// within their nearer halves, min(edges) / (2 tan(t / 2)); the least of all vertices. Infinite where
  /// nothing turns.
  double tightest_bend = 0;
  double least_bend = 0,
         greatest_bend = 0;  ///< the tightest bend may be, of vertices that are known to within a blur
};

/// Vertices are known to within `blur` (>= 0, units of the chain). Throws InputError for an open strand, one
/// of fewer than three vertices, an edge of length 0, and no strand. O(n).
PolygonShape shape_of(const Chain& chain, double blur = 0);

}  // namespace catena::bench
