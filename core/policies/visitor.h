#pragma once
#include <cstdint>

#include "catena/core/host_device.h"

namespace catena {

/// What the search of one sphere i reports as it goes. A visitor derives from this, adds hit(j) and overrides
/// what it wants to know; what it does not override costs nothing.
///
/// Order of the calls. Of an inner node: tested_node, then discarded, unless its children are looked at, at
/// once or later. Of another sphere j that is met: excluded, or tested_pair and then, if they collide, hit.
/// Of a batch: tested_batch, then this for those that are near. Spheres and nodes themselves come in any
/// order.
/// Each pair from both ends: the search of i accounts for every j != i once, and calls hit(j) where that of j
/// calls hit(i), but for rounded bounds, which may lose one end. Counting all hits gives the collisions of i;
/// who wants each pair once takes i < j.
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
