#pragma once
#include "catena/core/chain/chain.h"
#include "catena/properties/generators/dice.h"

namespace catena::properties {

/// A chain near this one: one to four random edits of numbers (an ulp, a factor, another sphere's value, the
/// radius that makes it touch another), of spheres (repeated, removed, exchanged) or of the rule. At most
/// `size` spheres, at least one; `chain` has at least one.
Chain mutate(const Chain& chain, Dice& dice, std::uint32_t size);

}  // namespace catena::properties
