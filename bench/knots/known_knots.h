#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "catena/bench/knots/published_knots.h"
#include "catena/core/chain/chain.h"

namespace catena::bench {

/// A polygon and what was published of it, or of its curve or its type.
struct KnownKnot {
  std::string input;  ///< where it comes from
  PublishedKnot published;
  Chain centres;    ///< closed strands
  double blur = 0;  ///< how far a vertex may be from where it belongs
};

/// Those that need no file: the two links whose least ropelength is proved, n >= 16 vertices a circle, and
/// torus knots that touch themselves, 8 n vertices, which no known trefoil and no knot may be shorter than.
std::vector<KnownKnot> carried_knots(std::uint32_t n);

}  // namespace catena::bench
