#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catena/bench/enumerate/published.h"

namespace catena::bench {

/// A lattice of points with whole coordinates, other than the square and the cubic one. All its points look
/// alike, or those an odd number of steps away look like the others reflected; so do all steps from a point.
struct OtherLattice {
  std::string name;
  std::vector<std::array<int, 3>>
      steps;             ///< from the origin; from points an odd number of steps away, negated
  int spacing;           ///< squared length of a step; no two points are nearer
  bool isometric;        ///< points are as far apart as on the lattice of that name, step for step
  PublishedTable table;  ///< of its self-avoiding walks

  /// A radius in steps, in the points' coordinates: the nearest in binary32 with which the same points
  /// collide.
  float in_coordinates(float in_steps) const;
};

/// honeycomb, triangular, diamond, body-centred and face-centred.
std::span<const OtherLattice> other_lattices();

/// Null where there is none of that name.
const OtherLattice* other_lattice(std::string_view name);

/// A walk on one, 4 bits a step. The first step is the lattice's first.
struct OtherWalk {
  static constexpr int most_steps = 16;

  const OtherLattice* lattice;
  std::uint64_t steps = 0;  ///< bits 4k .. 4k+3: step k, by its place in the lattice's list
  std::uint8_t length = 0;

  OtherWalk then(int step) const;
  /// Its length + 1 points.
  std::vector<std::array<int, 3>> points() const;
  /// How many walks are like it but for a symmetry that takes its first step to another.
  std::uint64_t images() const { return lattice->steps.size(); }
};

}  // namespace catena::bench
