#pragma once
#include <filesystem>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/properties/suite.h"

namespace catena::properties {

/// A crash or hang, shrunk: each try is a process of its own, made anew.
struct ShrunkFault {
  Chain chain;
  bool repeats;  ///< false: no new object does it on this chain; it depends on what was met before
};

/// The simplest chain found, within about `seconds`, on which a new object of the variant crashes or hangs
/// while it is held against the property. The calling process must not have made or described a variant of a
/// device.
ShrunkFault shrink_fault(const Finding& finding, Chain chain, double timeout, double seconds);

}  // namespace catena::properties
