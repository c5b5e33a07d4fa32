#pragma once
#include <cstdint>
#include <vector>

#include "catena/bench/tube/contacts.h"
#include "catena/bench/tube/tube.h"
#include "catena/core/chain/chain.h"

namespace catena::bench {

/// The first error: what a chain of n spheres on the centre line makes of a tube, before any number is
/// rounded and any algorithm runs. Inscribed spheres have the tube's radius and can only miss contacts;
/// covering spheres have the least radius that covers the tube and can only invent them. All are of order 2
/// in the spacing (anchors: gap h^2/8r and volume deficit h^2/12r^2 on a straight tube; curvature adds to
/// both).
struct TubeError {
  std::uint32_t n = 0;
  double spacing = 0;                    ///< along the centre line, in units of length
  double gap = 0;                        ///< Hausdorff distance from the tube to the inscribed spheres
  double volume_deficit = 0;             ///< share of the tube outside the inscribed spheres
  double covering_radius = 0;            ///< radius + gap
  std::uint32_t contacts = 0;            ///< true contact regions
  std::uint32_t missed = 0;              ///< of them, by the inscribed spheres
  std::uint32_t invented = 0;            ///< regions that do not touch, by the covering spheres
  std::uint32_t missed_by_covering = 0;  ///< 0 as a theorem
  double depth_error = 0;  ///< of the deepest contact, inscribed: the most wherever spheres may fall; >= 0
  double covering_depth_error = 0;  ///< the most that covering spheres make of it; >= 0
};

/// Spheres at equal arc lengths, the first at 0; n >= 8. Gap and deficit are measured on at most 2,000 gaps
/// between neighbours, spread evenly. `all` is approaches(tube). O(number of approaches).
TubeError tube_error(const Tube& tube, const std::vector<Approach>& all, std::uint32_t n);

/// The fewest spheres at equal arc lengths, at least 8, whose gap to the tube is at most `tolerance` radii;
/// above 0 and below 1. O(log spheres) gaps are measured as tube_error measures them.
std::uint32_t spheres_for(const Tube& tube, double tolerance);

/// The inscribed chain as it is stored, moved by `offset` on every axis: n >= 8 spheres at equal arc lengths,
/// neighbours by the arc window pi/2.
Chain inscribed_chain(const Tube& tube, std::uint32_t n, double offset = 0);

/// How far the farthest sphere of inscribed_chain is from where it belongs, for its coordinates are binary32.
double stored_error(const Tube& tube, std::uint32_t n, double offset = 0);

/// The second error: what storing a chain in binary32 changes, and how near its decisions are to changing.
struct StorageError {
  std::uint64_t pairs = 0;  ///< colliding pairs of the stored chain
  std::uint64_t flips = 0;  ///< pairs that the chain in binary64 decides otherwise
  double least_margin = 0;  ///< smallest |q - t| / t of the stored chain; its inverse is the condition number
  std::vector<std::uint64_t>
      decades;  ///< pairs with a margin in [10^-(k+1), 10^-k), the last: and below; k = 0..9
};

/// For the inscribed chain of n spheres, moved by `offset` on every axis. Pairs that collide or have a margin
/// below 1 are looked at, neighbours along the tube left out. Cost of reference::near_pairs.
StorageError storage_error(const Tube& tube, std::uint32_t n, double offset = 0);

}  // namespace catena::bench
