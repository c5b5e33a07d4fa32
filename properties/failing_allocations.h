#pragma once
#include <cstdint>
#include <limits>

#include "catena/properties/allocations.h"

namespace catena::properties {

/// While it lives no thread of this program gets memory by operator new any more, once `given` more were
/// given. Only in programs that have it so.
class FailingAllocations {
 public:
  static bool possible() { return Allocations::give() != nullptr; }
  explicit FailingAllocations(std::int64_t given) { Allocations::give()(given); }
  ~FailingAllocations() { Allocations::give()(std::numeric_limits<std::int64_t>::max()); }
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;
};

}  // namespace catena::properties
