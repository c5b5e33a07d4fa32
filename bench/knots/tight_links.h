#pragma once
#include <cstdint>

#include "catena/core/chain/chain.h"

namespace catena::bench {

/// A tight link of which it is proved that no shorter one exists, as vertices on its curves; thickness 1.
struct TightLink {
  Chain centres;    ///< each component a closed strand; radii are 0
  double blur = 0;  ///< how far the farthest vertex is from its curve, for coordinates are binary32
};

/// Two circles of radius 2, each through the other's centre (PublishedKnot "hopf"); `n` >= 3 vertices each. A
/// circle has a vertex in the other's centre, which is one diameter away from all vertices of the other: 2n -
/// 1 pairs touch.
TightLink hopf_link(std::uint32_t n);

/// Two such circles through the centres of the two half circles of a stadium (PublishedKnot
/// "chain-of-three"), whose straight sides are 2 long; n vertices a circle, n >= 4 even, and as many on the
/// half circles.
TightLink chain_of_three(std::uint32_t n);

}  // namespace catena::bench
