#pragma once
#include <cstdint>

#include "catena/core/host_device.h"

namespace catena {

/// What a per-sphere search reports as it goes. A visitor derives from this, adds hit(j) and overrides what
/// it wants to know; what it does not override costs nothing.
struct Visitor {
  /// The sphere was compared with an inner node ...
  CATENA_HD void tested_node(std::uint32_t /*slot*/) {}
  /// ... and the node's whole subtree left out.
  CATENA_HD void discarded(std::uint32_t /*slot*/) {}
  /// The sphere was compared with sphere j, which is no neighbour.
  CATENA_HD void tested_pair(std::uint32_t /*j*/) {}
  /// The sphere was compared with the spheres first, ..., first + count - 1 (at most 32, itself perhaps among
  /// them): it is separate for certain from sphere first + k unless bit k of `near` is set.
  CATENA_HD void tested_batch(std::uint32_t /*first*/, std::uint32_t /*count*/, std::uint32_t /*near*/) {}
  /// Sphere j was met and is a neighbour.
  CATENA_HD void excluded(std::uint32_t /*j*/) {}

  /// Called between steps that every sphere of a search takes alike. A device visitor brings the threads of a
  /// warp together again here; left to itself nvcc lets them drift apart for good after a rare branch with a
  /// call.
  CATENA_HD void converge() {}
};

}  // namespace catena
