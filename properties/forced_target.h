#pragma once
#include <cstdint>

#include "hwy/highway.h"

namespace catena::properties {

/// Forces an instruction set on every search of the process for as long as it lives.
class ForcedTarget {
 public:
  explicit ForcedTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ForcedTarget(const ForcedTarget&) = delete;
  ForcedTarget& operator=(const ForcedTarget&) = delete;
  ~ForcedTarget() { hwy::SetSupportedTargetsForTest(0); }
};

}  // namespace catena::properties
