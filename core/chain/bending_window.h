#pragma once
#include <numbers>

#include "catena/core/compiled_for.h"

namespace catena {

/// The arc window of what a tube can bend into, which is no contact: spheres nearer along it than so many
/// times the sum of their radii. Exclusion::arc takes it.
inline constexpr double bending_window = std::numbers::pi / 2;

}  // namespace catena
