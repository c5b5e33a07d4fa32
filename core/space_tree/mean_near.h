#pragma once
#include <cstdint>
#include <span>

#include "catena/core/chain/chain_view.h"

namespace catena {

/// Pairs of spheres a sphere of the chain, itself among them, whose centres are no farther apart along any
/// axis than one and a half times the sum of their radii: about what a search by cells compares. The mean
/// over these, at least one, told by a look at some of the chain: four comparisons a sphere of it, or fewer.
double mean_near(const ChainView& chain, std::span<const std::uint32_t> of);

}  // namespace catena
