#pragma once
#include <cstdint>

#include "catena/core/host_device.h"
#include "catena/core/policies/visitor.h"
#include "catena/core/strategy/resident.h"

namespace catena::cuda {

/// Adds `mine` of every calling thread to *total and gives each its own range: one atomic for the threads of
/// the warp that are here together.
__device__ inline unsigned long long aggregated_add(unsigned long long* total) {
  const unsigned here = __activemask(), lane = threadIdx.x & 31u;
  const int leader = __ffs(static_cast<int>(here)) - 1;
  unsigned long long base = 0;
  if (static_cast<int>(lane) == leader)
    base = atomicAdd(total, static_cast<unsigned long long>(__popc(here)));
  return __shfl_sync(here, base, leader) + __popc(here & ((1u << lane) - 1u));
}

/// What one thread found for its sphere: collisions in a register, pairs appended at once when they are
/// wanted.
struct DeviceVisitor : Visitor {
  CATENA_HD DeviceVisitor(std::uint32_t sphere, const ResidentAnswer& to) : i(sphere), answer(to) {}

  CATENA_HD void hit(std::uint32_t j) {
    ++collisions;
    if (i > j) return;
#ifdef __CUDA_ARCH__
    if (answer.pairs == nullptr) {
      ++later;
      return;
    }
    const unsigned long long place = aggregated_add(&answer.state->found);
    if (place < answer.capacity)
      answer.pairs[place] = {i, j};
    else
      answer.state->overflow = 1;
#endif
  }

  CATENA_HD void converge() {
#ifdef __CUDA_ARCH__
    __syncwarp();
#endif
  }

  /// True when another thread has answered Want::any already.
  __device__ bool satisfied() const {
    return answer.count == nullptr && answer.pairs == nullptr &&
           *static_cast<volatile unsigned long long*>(&answer.state->found) > 0;
  }

  /// Counts the pairs that were not appended; call once, when the search is over.
  __device__ void finish() {
    if (later > 0) atomicAdd(&answer.state->found, static_cast<unsigned long long>(later));
  }

  std::uint32_t i, collisions = 0, later = 0;
  const ResidentAnswer& answer;
};

}  // namespace catena::cuda
