#pragma once
#include <functional>
#include <string>
#include <vector>

#include "catena/core/vec3.h"

namespace catena::bench {

/// A tube that is known exactly: every point nearer than `radius` to a smooth centre line, which is given by
/// its arc length. The truth that a chain of spheres approximates.
struct Tube {
  std::string name;
  double length = 0;                     ///< of the centre line
  double radius = 1;                     ///< curvature times radius stays below 1
  bool closed = false;                   ///< position(0) = position(length)
  std::function<Vec3(double)> position;  ///< the centre line at arc length s, 0 <= s <= length, to 1e-13

  /// Arc length between two places, the short way around when closed.
  double apart(double s, double t) const;
  /// Nearer along the tube than what it could bend into: never a contact. The arc window pi/2 of a Chain.
  bool neighbours(double s, double t) const { return apart(s, t) < 3.1415926535897932 * radius; }
};

/// A straight tube of length 40 and radius 1: no contacts.
Tube straight_rod();
/// A spring of ten turns of radius 6, radius 1, whose turns go `depth` through each other along their whole
/// length. As thin as 1e-5 it grazes: a chain finds the contact only when its dips are less deep.
Tube helix(double depth = 0.1, std::string name = "helix");
/// The torus knot (p, p + 1), thicker than its windings leave room for: they overlap by `depth` radii.
Tube torus_knot(unsigned p = 2, double depth = 0.1, std::string name = "torus_knot");
/// A closed curve that crosses itself in projection many times, at heights that make some crossings touch,
/// deep and shallow, and others just not.
Tube lissajous();
/// The splines of the paper's two paths, about 1,800 radii long: nine crossings, from 0.4 radii deep to 0.02
/// apart.
Tube path1_tube();
Tube path2_tube();

/// The names of all of them.
std::vector<std::string> known_tubes();

/// Those of these names; all when there are none. Throws InputError that names those there are.
std::vector<Tube> tubes_named(const std::vector<std::string>& names);

}  // namespace catena::bench
