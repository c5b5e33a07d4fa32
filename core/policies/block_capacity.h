#pragma once
#include <cstdint>
#include <string>

#include "catena/core/error.h"

namespace catena::policy {

/// bGPU2's declared limit: one block takes two spheres a thread. Throws CapacityError past it, pointing to
/// the strategy that has no limit. No fmt here: nvcc 13 cannot compile its compile-time checks.
inline void require_block_capacity(const std::string& name, const std::string& instead, std::uint32_t n,
                                   std::uint32_t block) {
  if (n <= 2 * block) return;
  throw CapacityError(name + " takes at most " + std::to_string(2 * block) + " spheres by one block of " +
                      std::to_string(block) + " threads, got " + std::to_string(n) + "; use " + instead);
}

}  // namespace catena::policy
