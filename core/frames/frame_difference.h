#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/sphere.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// Fills `ranges` with stretches, ascending and apart, outside of which two frames of as many spheres are the
/// same bit for bit. False, and of no use, when there would be more stretches than `ranges` has capacity for,
/// or they would hold more than `most` spheres. Stops there. Does not allocate.
CATENA_API bool differing(std::span<const Sphere> before, std::span<const Sphere> now, std::uint32_t most,
                          std::vector<SphereRange>& ranges);

/// About which share of the spheres differs, by some of them; 1 when each of those does.
CATENA_API double share_that_differs(std::span<const Sphere> before, std::span<const Sphere> now);

/// s != 0, |s| <= most, such that sphere i now is bit for bit sphere i + s before, for all i that both have.
/// Every one is compared. Tries `guess` first, then the places where an end of one frame is found in the
/// other.
CATENA_API std::optional<std::int64_t> shift_between(std::span<const Sphere> before,
                                                     std::span<const Sphere> now, std::uint32_t most,
                                                     std::int64_t guess);

}  // namespace catena
