#pragma once
#include <cstdint>
#include <span>

#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"

namespace catena {

/// Pairs of spheres a sphere of the chain, itself among them, that searches of single spheres look at, about.
struct NearSpheres {
  /// Centres no farther apart along any axis than one and a half times the sum of radii, as told by those no
  /// farther than that sum: boxes that meet.
  double by_reach;
  /// Those in the 27 cells around one, which are as wide as two of the radius that is given.
  double in_cells;
};

/// Spheres that mean_near takes at most.
constexpr std::size_t most_samples = 32;

/// The mean over these spheres, at least one and at most `most_samples`, told by a look at one of so many
/// `parts` of the chain; with one at all of it. O(of.size() n / parts).
CATENA_API NearSpheres mean_near(const ChainView& chain, std::span<const std::uint32_t> of,
                                 float greatest_radius, std::uint32_t parts);

}  // namespace catena
