#pragma once
#include <span>

#include "catena/core/motion/derivatives.h"
#include "catena/core/pair.h"

namespace catena::motion {

/// The response to contacts: without friction, each pair repels with half * stiffness * depth^2, where depth
/// is what the distance lacks of `reach`. A pair that is apart adds nothing, so a list of pairs may hold too
/// many; one that lacks a pair lets the two through.
struct ContactResponse {
  double stiffness = 100;  ///< force of one pair at a depth of 1
  double reach = 2;        ///< two radii

  double energy(const Coordinates& x, std::span<const Pair> pairs) const;
  /// Two nodes at one place have no direction to part in and add nothing.
  void add_derivatives(const Coordinates& x, std::span<const Pair> pairs, Derivatives& out) const;
};

}  // namespace catena::motion
