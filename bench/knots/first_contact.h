#pragma once
#include <cstdint>
#include <optional>

#include "catena/core/chain/bending_window.h"
#include "catena/core/chain/chain.h"
#include "catena/core/strategy/variant.h"

namespace catena::bench {

/// Where spheres that grow about the vertices of a tube touch for the first time.
struct FirstContact {
  float radius = 0;     ///< the least binary32 radius at which two spheres collide that are no neighbours
  Pair pair{0, 0};      ///< that do
  float apart() const;  ///< the radius before it: no two collide there, nor at any smaller one
};

/// The chain's centres and strands, each sphere of this radius, under the arc window `bending_window`.
Chain tube_of(const Chain& centres, float radius);

/// From all pairs that the variant finds at `greatest`, neighbours along the tube among them, the one that a
/// growing sphere meets first, decided exactly. Nothing where there is no contact up to that radius. A larger
/// radius may have fewer contacts, since its window is larger, so that no bisection would do. Cost of a
/// search at `greatest` under an index window of 1.
std::optional<FirstContact> first_contact(Variant& variant, const Chain& centres, float greatest);

/// Pairs of tube_of(centres, radius), counted by the variant.
std::uint64_t contacts_at(Variant& variant, const Chain& centres, float radius);

}  // namespace catena::bench
