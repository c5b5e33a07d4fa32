#pragma once
#include <vector>

#include "catena/bench/tube/tube.h"

namespace catena::bench {

/// A region of (s, t), s < t, in which a tube comes near itself.
struct Approach {
  struct Row {
    double s, t;  ///< a place and the nearest place beside it, to about the grid
  };
  double s, t;            ///< where it comes nearest
  double distance;        ///< of the centre line from itself there, to 1e-12
  std::vector<Row> rows;  ///< the region, in steps of s

  /// How far the tube goes through itself; negative when it stays apart.
  double depth(double radius) const { return 2 * radius - distance; }
};

/// Every place where the centre line comes nearer to itself than 2.25 radii, other than along the tube: the
/// true contacts are those at 2 radii or less, whatever chain approximates the tube. Found on a grid of
/// radius/8 and refined; regions that grow together within the grid count as one. O((length/radius)^2).
std::vector<Approach> approaches(const Tube& tube);

/// Those of `all` that touch.
std::vector<Approach> contacts(const Tube& tube, const std::vector<Approach>& all);

}  // namespace catena::bench
