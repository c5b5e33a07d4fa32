#pragma once
#include <cstdint>

#include "catena/core/host_device.h"

namespace catena {

/// What a per-sphere search reports as it goes. A visitor derives from this, adds hit(j) and overrides what it
/// wants to know; what it does not override costs nothing.
struct Visitor {
  CATENA_HD void tested_node(std::uint32_t /*slot*/) {}  ///< the sphere was compared with an inner node
  CATENA_HD void discarded(std::uint32_t /*slot*/) {}    ///< ... and the node's whole subtree left out
  CATENA_HD void tested_pair(std::uint32_t /*j*/) {}     ///< the sphere was compared with sphere j, not a neighbour
  CATENA_HD void excluded(std::uint32_t /*j*/) {}        ///< sphere j was met and is a neighbour
};

}  // namespace catena
