#pragma once
#include "catena/core/hierarchy/bound.h"
#include "catena/core/sphere.h"

namespace catena::reference {

/// Proper as bounds.h says: a bound of which something can be true.
bool proper(const AnyBound& bound);

/// True when a proper bound leaves out no point.
bool is_everything(const AnyBound& bound);

inline Vector64 centre(const Sphere64& s) { return {s.x, s.y, s.z}; }
/// The sphere as the capsule it is.
inline Capsule64 capsule(const Sphere64& s) { return {centre(s), centre(s), s.radius}; }

}  // namespace catena::reference
