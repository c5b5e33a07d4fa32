#pragma once
#include <cstdint>

namespace catena::properties {

/// While it lives no thread of this program gets memory by operator new any more, once `given` more were
/// given.
class FailingAllocations {
 public:
  explicit FailingAllocations(std::int64_t given);
  ~FailingAllocations();
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;
};

}  // namespace catena::properties
