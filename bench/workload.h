#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/reference/reference.h"

namespace catena::bench {

/// A chain to measure on, with its exact answer.
struct Workload {
  Chain chain;
  reference::Answer exact;
};

/// The middle frame of "scene:n=N", where the most collides. The last few workloads are kept, as making one
/// and its exact answer takes longer than measuring.
std::shared_ptr<const Workload> workload(const std::string& scene, std::uint32_t n);

}  // namespace catena::bench
