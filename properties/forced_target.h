#pragma once
#include <cstdint>
#include <vector>

#include "catena/core/blocks/simd_targets.h"  // before Highway, so that all mean the same sets
#include "hwy/highway.h"

namespace catena::properties {

/// The instruction sets that ForcedTarget takes here, the best first; 0, which is whatever runs unforced,
/// where Highway counts none: on ARM without AES, say.
inline std::vector<std::int64_t> targets_here() {
  std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  if (targets.empty()) targets.push_back(0);
  return targets;
}

/// Forces an instruction set on every search of the process for as long as it lives.
class ForcedTarget {
 public:
  explicit ForcedTarget(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ForcedTarget(const ForcedTarget&) = delete;
  ForcedTarget& operator=(const ForcedTarget&) = delete;
  ~ForcedTarget() { hwy::SetSupportedTargetsForTest(0); }
};

}  // namespace catena::properties
