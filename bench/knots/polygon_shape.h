#pragma once
#include "catena/core/chain/chain.h"

namespace catena::bench {

/// The closed polygons whose vertices are the centres of a chain, by binary64.
struct PolygonShape {
  double length = 0;                          ///< of all strands
  double shortest_edge = 0, longest_edge = 0;
  /// Rawdon's MinRad: at a vertex where the polygon turns by t, the radius of the arc that touches both edges within
  /// their nearer halves, min(edges) / (2 tan(t / 2)); the least of all vertices. Infinite where nothing turns.
  double tightest_bend = 0;
};

/// Vertices are known to within `blur` (>= 0, units of the chain); of the bends that such vertices may have, the
/// greatest is taken. Throws InputError for an open strand, one of fewer than three vertices, an edge of length 0, and no
/// strand. O(n).
PolygonShape shape_of(const Chain& chain, double blur = 0);

}  // namespace catena::bench
