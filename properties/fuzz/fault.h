#pragma once
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/properties/suite.h"

namespace catena::properties {

/// A crash or hang, shrunk: each try is a process of its own, made anew.
struct ShrunkFault {
  std::vector<Chain> chains;  ///< one, or, where it depends on history, what one object meets in this order
  bool repeats;               ///< false: no new object does it, not even after the chains before
};

/// The simplest chain found, within about `seconds`, on which a new object of the variant crashes or hangs
/// while it is held against the property; where none does, the shortest sequence of `before` and it. The
/// calling process must not have made or described a variant of a device.
ShrunkFault shrink_fault(const Finding& finding, Chain chain, std::vector<Chain> before, double timeout,
                         double seconds);

}  // namespace catena::properties
