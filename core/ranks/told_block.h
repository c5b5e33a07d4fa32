#pragma once
#include <cstdint>
#include <span>

#include "catena/core/hierarchy/box.h"
#include "catena/core/sphere.h"

namespace catena::ranks {

/// What a rank tells another of a block that the other may ask for: a capsule around its spheres, from the
/// centre of the first to that of the last. A box around a piece of curve that goes along no axis is empty
/// for the most part, and half of what meets it would ask for the block in vain.
struct ToldBlock {
  std::uint32_t block;      ///< its number on the rank that tells
  float first[3], last[3];  ///< ends of the axis
  float radius;             ///< around it; may be infinite

  /// The axis of at least one sphere, of radius 0.
  static ToldBlock along(std::uint32_t block, std::span<const Sphere> spheres);
  /// Takes the least radius, as far as it is known, that holds these spheres.
  void hold(std::span<const Sphere> spheres);

  /// A box around all of it.
  Box box() const;
  /// False only where the sphere touches none of the block's.
  bool may_touch(const Sphere& sphere) const;
};

}  // namespace catena::ranks
