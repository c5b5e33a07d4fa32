#pragma once
#include "catena/core/hierarchy/bound.h"

namespace catena::reference {

/// Ends between which numbers certainly lie; infinite where nothing is known.
struct Range {
  double low, high;
};

/// The range of direction . (p - origin) over all points p of a proper bound, in binary64 with its error
/// added: low is at most the least and high at least the greatest, both by less than 2^-45 of the greatest
/// term. Slabs are bounded along their own directions only.
Range along(const Vector64& direction, const Vector64& origin, const AnyBound& bound);

}  // namespace catena::reference
