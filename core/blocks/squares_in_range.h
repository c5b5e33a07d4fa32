#pragma once
#include "catena/core/chain/chain_view.h"
#include "catena/core/export.h"

namespace catena {

/// Whether squares of distances such as this radius keep their digits in binary32. Where they do not, the
/// chain's order scales its numbers, and tests of single spheres scale what they compare.
inline bool squares_in_range(float radius) { return radius == 0 || (radius > 0x1p-44f && radius < 0x1p58f); }

/// Whether no sum of radii comes near to overflow: each can be scaled to 1 to 2 then, and a difference of
/// centres that overflows is greater than it. Else tests of single spheres leave each pair that is near to
/// the exact stage.
inline bool sums_in_range(const Extent& extent) { return extent.greatest_radius < 0x1p126f; }

/// What a search of spheres one by one takes, of what it would of a chain in range: more where sums of radii
/// overflow, or differences are subnormal and this machine is slow with these. Trees of blocks are as fast as
/// ever, unless a number would lose a bit where the chain is scaled for them.
CATENA_API double single_spheres_share(const Extent& extent);

}  // namespace catena
