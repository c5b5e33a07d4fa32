#pragma once
#include <limits>

#include "catena/core/chain/chain_view.h"
#include "catena/core/hierarchy/hierarchy.h"

namespace catena {

/// What scale the radii of a chain and of every tree of parents over it have: arithmetic may leave out what
/// is for other scales (Robust::in_range).
struct RadiusRange {
  float least;  ///< no sphere has a smaller radius
  float reach;  ///< no two bounds of a tree of parents over the chain have radii of a greater sum
};

/// A parent's centre lies between its children's, so in the box of all centres, and its radius is at most
/// half the box's diagonal above the greater child's: at most max_hierarchy_height times. Twice that
/// outweighs all rounding.
inline RadiusRange radius_range(const Extent& chain) {
  const double greatest = chain.greatest_radius + max_hierarchy_height * chain.sides,
               reach = 2 * 2 * greatest;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {chain.least_radius,
          reach < std::numeric_limits<float>::max() ? static_cast<float>(reach) : infinity};
}

}  // namespace catena
